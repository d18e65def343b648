#include "exchange/writeEvents.h"

#include "analyse/columns.h"
#include "base/files/AtomicFile.h"
#include "base/json.h"
#include "exchange/csvText.h"
#include "exchange/reviewedText.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

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

    void writeTracksCsv(AtomicFile &file, const Analysis &analysis, const std::vector<Track> &tracks)
    {
        constexpr std::size_t blockBytes = 1 << 16; // tracks may have a row for every frame of a day
        const auto columns = trackColumns(analysis.grid(), OptionalColumns::of(analysis));
        std::string text = "track," + csvNames(columns) + "\n";
        for (const Track &track : tracks)
            for (const std::size_t i : track.presentPoints()) {
                text += std::to_string(track.id) + "," + csvCells(columns, {&analysis, &track, i}) + "\n";
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
        file.write("{\"track\":" + std::to_string(track.id));
        for (const auto &column : trackColumns(analysis.grid(), OptionalColumns::of(analysis))) {
            Json values = Json::array();
            for (const std::size_t i : present)
                values.push_back(cellJson(column.value({&analysis, &track, i})));
            file.write("," + Json(column.name).dump() + ":" + values.dump());
        }
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

std::string eventsCsv(const AnalysisPlan &plan, const std::vector<Event> &events)
{
    const auto columns = eventColumns(plan.grid(), OptionalColumns::of(plan));
    std::string text = csvNames(columns) + "\n";
    for (const Event &e : events)
        text += csvCells(columns, e) + "\n";
    return text;
}

std::string eventsJson(const AnalysisPlan &plan, const std::vector<Event> &events, const std::vector<AreaEvent> &areas)
{
    Json json;
    json["threshold"] = plan.threshold;
    json["statisticUnit"] = statisticUnit(plan.settings.detector);
    json["lnK"] = plan.calibration->lnK;
    json["settings"] = parseJson(settingsToJson(plan.settings), "settings");
    json["events"] = Json::array();
    for (const Event &e : events)
        json["events"].push_back(eventJson(e, plan));
    if (OptionalColumns::of(plan).secondPass)
        json["areas"] = Json::array();
    for (const AreaEvent &area : areas) {
        Json one;
        for (const TableColumn<AreaEvent> &column : areaColumns())
            one[column.name] = cellJson(column.value(area));
        json["areas"].push_back(one);
    }
    return json.dump(2) + "\n";
}

std::string eventsSigmf(const Analysis &analysis)
{
    if (!analysis.recording)
        throw Error("events as SigMF", "require a recording; write .csv or .json for ready-made frames");
    const RecordingInfo &info = analysis.recording->info();
    Json json =
        sigmfMetadata(info, std::string("Events found by Faintline's ")
                                + (isScoreOfPaths(analysis.settings.detector)
                                       ? "sequential Markov detector"
                                       : "detector " + std::string(detectorNames[analysis.settings.detector.index()])));
    for (const Event &e : events(analysis)) {
        Annotation box; // as with reviews, which so take the place of these
        fillBox(analysis, e, box);
        box.label = "event " + std::to_string(e.id);
        box.note =
            "statistic " + formatNumber(e.statistic) + " " + std::string(statisticUnit(analysis.settings.detector));
        if (!std::isnan(e.snrDb))
            box.note += ", SNR " + roundedDb(e.snrDb) + " dB in one window";
        addAnnotation(json, box, info);
    }
    for (const AreaEvent &area : areaEvents(analysis))
        addAnnotation(json,
                      {area.onsetSeconds, area.endSeconds, area.low, area.high, "area",
                       "not a line: level raised by at least " + roundedDb(area.levelDb) + " dB"},
                      info);
    return sigmfText(std::move(json));
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
        writeTextFile(path, eventsSigmf(analysis));
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
