#include "exchange/writeEvents.h"

#include "base/files/AtomicFile.h"
#include "base/json.h"
#include "base/logmath.h"
#include "detect/statisticDecimals.h"
#include "exchange/positionNames.h"
#include "exchange/reviewedText.h"
#include "refine/secondLook.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace faintline {

namespace {

    std::string joined(const std::vector<std::string> &words)
    {
        std::string all;
        for (const std::string &word : words)
            all += (all.empty() ? "" : ",") + word;
        return all;
    }

    std::string joined(const std::vector<double> &numbers)
    {
        std::vector<std::string> words;
        for (double number : numbers)
            words.push_back(formatNumber(number));
        return joined(words);
    }

    const std::vector<std::string> smoothedColumns{"f_low", "f_high", "presence", "snr_db"};

    /// 5 and 95 % quantiles of a point's position, probability that the signal is present, and its SNR in one frame.
    std::vector<double> numbersOf(const SmoothedPoint &point, const Axis &axis)
    {
        return {axis.value(double(point.low)), axis.value(double(point.high)), double(point.presence),
                dbFromRatio(double(point.level))};
    }

    /// Names of the rates along each axis of a grid of several axes.
    std::vector<std::string> rateNames(const Grid &grid)
    {
        std::vector<std::string> names;
        if (grid.isSpectrum())
            return names;
        for (const Axis &axis : grid.axes)
            names.push_back(axis.name + "_per_s");
        return names;
    }

    /// Columns of the events of a bank: the model that found it, and the others that took over, "t:name;…".
    const std::vector<std::string> bankNames{"model", "model_changes"};
    std::string bankTexts(const Event &e)
    {
        return nameOfBankModel(e.model) + "," + modelChangesText(e);
    }

    std::string modelOf(const TrackPoint &point, const Track &track)
    {
        return nameOfBankModel(modelAt(point.frame, track.model, track.modelChanges));
    }

    /// Columns of tracks that were smoothed from both ends.
    const std::vector<std::string> smoothedNames{"snr_db", "band_hz", "noise_probability", "window_s"};
    std::vector<double> smoothedOf(const Event &e)
    {
        return {e.snrDb, e.bandWidth, e.noiseProbability, e.windowSeconds};
    }

    /// Rounded as displayed, with its unit.
    std::string shownStatistic(const Event &e, const Analysis &analysis)
    {
        const double steps = std::pow(10.0, statisticDecimals(analysis.settings.detector));
        return formatNumber(std::round(steps * e.statistic) / steps) + " "
               + std::string(statisticUnit(analysis.settings.detector));
    }

    std::string audacityLabels(const Analysis &analysis)
    {
        std::string text;
        for (const Event &e : events(analysis))
            text += formatNumber(e.onsetSeconds) + "\t" + formatNumber(e.endSeconds) + "\t"
                    + formatNumber(e.position.back()) + " Hz, " + shownStatistic(e, analysis) + "\n";
        return text;
    }

    std::string roundedDb(double db)
    {
        return formatNumber(std::round(10.0 * db) / 10.0);
    }

    std::string sigmfAnnotations(const Analysis &analysis)
    {
        if (!analysis.recording)
            throw Error("events as SigMF", "require a recording; write .csv or .json for ready-made frames");
        const RecordingInfo &info = analysis.recording->info();
        const double centre = info.centreHz;
        Json json = sigmfMetadata(
            info, std::string("Events found by Faintline's ")
                      + (isScoreOfPaths(analysis.settings.detector)
                             ? "sequential Markov detector"
                             : "detector " + std::string(detectorNames[analysis.settings.detector.index()])));
        for (const Event &e : events(analysis)) {
            Annotation box; // as with reviews, which so take the place of these
            fillBox(analysis, e, box);
            Json annotation;
            setSigmfTimes(annotation, box.startSeconds, box.endSeconds, info);
            annotation["core:freq_lower_edge"] = centre + box.lowHz.value_or(0.0);
            annotation["core:freq_upper_edge"] = centre + box.highHz.value_or(0.0);
            annotation["core:label"] = "event " + std::to_string(e.id);
            std::string comment =
                "statistic " + formatNumber(e.statistic) + " " + std::string(statisticUnit(analysis.settings.detector));
            if (!std::isnan(e.snrDb))
                comment += ", SNR " + roundedDb(e.snrDb) + " dB in one window";
            annotation["core:comment"] = comment;
            json["annotations"].push_back(annotation);
        }
        for (const AreaEvent &area : areaEvents(analysis)) {
            Json annotation;
            setSigmfTimes(annotation, area.onsetSeconds, area.endSeconds, info);
            annotation["core:freq_lower_edge"] = centre + area.low;
            annotation["core:freq_upper_edge"] = centre + area.high;
            annotation["core:label"] = "area";
            annotation["core:comment"] = "not a line: level raised by at least " + roundedDb(area.levelDb) + " dB";
            json["annotations"].push_back(annotation);
        }
        // The specification requires them in order of their start.
        std::stable_sort(json["annotations"].begin(), json["annotations"].end(), [](const Json &a, const Json &b) {
            return a["core:sample_start"].get<long long>() < b["core:sample_start"].get<long long>();
        });
        return json.dump(2) + "\n";
    }

    void writeTracksCsv(AtomicFile &file, const Analysis &analysis, const std::vector<Track> &tracks)
    {
        constexpr std::size_t blockBytes = 1 << 16; // tracks may have a row for every frame of a day
        const bool isSeenTwice = looksTwice(analysis);
        std::string text =
            joined(std::vector<std::string>{"track", "t", joined(positionNames(analysis.grid())), "statistic"})
            + (isSeenTwice ? ',' + joined(smoothedColumns) : "") + (analysis.isBank() ? ",model" : "") + "\n";
        for (const Track &track : tracks)
            for (const std::size_t i : track.presentPoints()) {
                const TrackPoint &point = track.points[i];
                text += std::to_string(track.id) + "," + formatNumber(analysis.time().value(double(point.frame))) + ","
                        + joined(track.positionOf(i, analysis.grid())) + "," + formatNumber(point.statistic);
                if (isSeenTwice)
                    text += ',' + joined(numbersOf(track.smoothed[i], analysis.grid().axes.back()));
                if (analysis.isBank())
                    text += ',' + modelOf(point, track);
                text += "\n";
                if (text.size() > blockBytes) {
                    file.write(text);
                    text.clear();
                }
            }
        file.write(text);
    }

    void writeTrackJson(AtomicFile &file, const Analysis &analysis, const Track &track)
    {
        const std::vector<std::size_t> present = track.presentPoints();
        const auto writeColumn = [&](const std::string &name, const auto &valueOf) {
            Json values = Json::array();
            for (const std::size_t i : present)
                values.push_back(valueOf(i));
            file.write("," + Json(name).dump() + ":" + values.dump());
        };
        file.write("{\"track\":" + std::to_string(track.id));
        writeColumn("t", [&](std::size_t i) { return analysis.time().value(double(track.points[i].frame)); });
        const std::vector<std::string> names = positionNames(analysis.grid());
        for (std::size_t axis = 0; axis < names.size(); ++axis)
            writeColumn(names[axis], [&](std::size_t i) { return track.positionOf(i, analysis.grid())[axis]; });
        writeColumn("statistic", [&](std::size_t i) { return track.points[i].statistic; });
        for (std::size_t column = 0; column < smoothedColumns.size() && looksTwice(analysis); ++column)
            writeColumn(smoothedColumns[column], [&](std::size_t i) {
                return numbersOf(track.smoothed[i], analysis.grid().axes.back())[column];
            });
        if (analysis.isBank())
            writeColumn("model", [&](std::size_t i) { return modelOf(track.points[i], track); });
        file.write("}");
    }

    void checkExtension(const std::string &path, std::initializer_list<std::string_view> extensions,
                        const std::string &known)
    {
        if (std::none_of(extensions.begin(), extensions.end(),
                         [&](std::string_view extension) { return path.ends_with(extension); }))
            throw Error(path, "the file name must end in one of " + known);
    }

    void writeTracks(const Analysis &analysis, const std::vector<Track> &tracks, const std::string &path)
    {
        checkTracksPath(path);
        AtomicFile file(path);
        if (path.ends_with(".csv")) {
            writeTracksCsv(file, analysis, tracks);
        } else {
            for (const Track &track : tracks) {
                file.write(&track == &tracks.front() ? "[" : ",");
                writeTrackJson(file, analysis, track);
            }
            file.write(tracks.empty() ? "[]\n" : "]\n");
        }
        file.commit();
    }

} // namespace

void checkEventsPath(const std::string &path)
{
    checkExtension(path, {".csv", ".json", ".txt", ".sigmf-meta"},
                   ".csv, .json, .txt (Audacity labels) or .sigmf-meta");
}

void checkTracksPath(const std::string &path)
{
    checkExtension(path, {".csv", ".json"}, ".csv or .json");
}

std::string modelChangesText(const Event &event)
{
    std::string text;
    for (const auto &[seconds, model] : event.modelChanges)
        text += formatNumber(seconds) + ':' + nameOfBankModel(model) + ';';
    return text.substr(0, text.size() - std::min<std::size_t>(1, text.size()));
}

std::string eventsCsv(const AnalysisPlan &plan, const std::vector<Event> &events)
{
    std::vector<std::string> names{
        "event",          "t_onset",   "t_detect",  "t_end", joined(positionNames(plan.grid())),
        "drift_hz_per_s", "statistic", "confirmed", "open"};
    const std::vector<std::string> rates = rateNames(plan.grid());
    names.insert(names.end(), rates.begin(), rates.end());
    const bool isSeenTwice = looksTwice(plan);
    if (isSeenTwice)
        names.insert(names.end(), smoothedNames.begin(), smoothedNames.end());
    const bool subtracts = plan.settings.subtract.lines;
    if (subtracts)
        names.push_back("subtracted");
    if (plan.isBank())
        names.insert(names.end(), bankNames.begin(), bankNames.end());
    std::string text = joined(names) + "\n";
    for (const Event &e : events) {
        const std::vector<std::string> cells{
            std::to_string(e.id),       formatNumber(e.onsetSeconds), formatNumber(e.detectSeconds),
            formatNumber(e.endSeconds), joined(e.position),           formatNumber(e.driftPerSecond),
            formatNumber(e.statistic),  e.isConfirmed ? "1" : "0",    e.isOpen ? "1" : "0"};
        text += joined(cells) + (rates.empty() ? "" : ',' + joined(e.ratesPerSecond))
                + (isSeenTwice ? ',' + joined(smoothedOf(e)) : "")
                + (!subtracts       ? ""
                   : e.isSubtracted ? ",1"
                                    : ",0")
                + (plan.isBank() ? ',' + bankTexts(e) : "") + "\n";
    }
    return text;
}

Json eventJson(const Event &e, const Grid &grid)
{
    Json json;
    json["event"] = e.id;
    json["t_onset"] = e.onsetSeconds;
    json["t_detect"] = e.detectSeconds;
    json["t_end"] = e.endSeconds;
    const std::vector<std::string> names = positionNames(grid);
    for (std::size_t axis = 0; axis < names.size(); ++axis)
        json[names[axis]] = e.position[axis];
    json["drift_hz_per_s"] = e.driftPerSecond;
    const std::vector<std::string> rates = rateNames(grid);
    for (std::size_t axis = 0; axis < rates.size(); ++axis)
        json[rates[axis]] = e.ratesPerSecond[axis];
    json["statistic"] = e.statistic;
    json["confirmed"] = e.isConfirmed;
    json["open"] = e.isOpen;
    if (e.isSubtracted)
        json["subtracted"] = true;
    for (const auto &[seconds, model] : e.modelChanges)
        json["model_changes"].push_back({{"t", seconds}, {"model", nameOfBankModel(model)}});
    for (std::size_t i = 0; i < smoothedNames.size() && !std::isnan(e.snrDb); ++i)
        json[smoothedNames[i]] = smoothedOf(e)[i];
    return json;
}

std::string eventsJson(const AnalysisPlan &plan, const std::vector<Event> &events, const std::vector<AreaEvent> &areas)
{
    Json json;
    json["threshold"] = plan.threshold;
    json["statisticUnit"] = statisticUnit(plan.settings.detector);
    json["lnK"] = plan.calibration->lnK;
    json["settings"] = parseJson(settingsToJson(plan.settings), "settings");
    json["events"] = Json::array();
    for (const Event &e : events) {
        json["events"].push_back(eventJson(e, plan.grid()));
        if (plan.isBank())
            json["events"].back()["model"] = nameOfBankModel(e.model);
    }
    if (looksTwice(plan))
        json["areas"] = Json::array();
    for (const AreaEvent &area : areas)
        json["areas"].push_back({{"t_onset", area.onsetSeconds},
                                 {"t_end", area.endSeconds},
                                 {"f_low", area.low},
                                 {"f_high", area.high},
                                 {"level_db", area.levelDb}});
    return json.dump(2) + "\n";
}

std::string eventsSigmf(const Analysis &analysis)
{
    return sigmfAnnotations(analysis);
}

void writeEvents(const Analysis &analysis, const std::string &path)
{
    checkEventsPath(path);
    if (path.ends_with(".csv"))
        writeTextFile(path, eventsCsv(analysis, events(analysis)));
    else if (path.ends_with(".json"))
        writeTextFile(path, eventsJson(analysis, events(analysis), areaEvents(analysis)));
    else if (path.ends_with(".txt"))
        writeTextFile(path, audacityLabels(analysis));
    else
        writeTextFile(path, sigmfAnnotations(analysis));
}

void writeTracks(const Analysis &analysis, const std::string &path)
{
    writeTracks(analysis, analysis.tracks, path);
}

void writeTracksOf(const std::vector<Event> &events, const Analysis &analysis, const std::string &path)
{
    std::vector<Track> tracks;
    for (const Track &track : analysis.tracks)
        if (std::any_of(events.begin(), events.end(), [&](const Event &event) { return event.id == track.id; }))
            tracks.push_back(track);
    writeTracks(analysis, tracks, path);
}

} // namespace faintline
