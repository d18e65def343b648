#include "exchange/writeReviewed.h"

#include "base/AtomicFile.h"
#include "base/oneLine.h"
#include "exchange/annotationText.h"
#include "exchange/csvText.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// One line of the list: an event, or a box somebody drew.
    struct Row {
        const Event *event = nullptr;
        int signal = 0;
        Annotation box; ///< an event's too: what its track fills
    };

    /// What an event's track fills on the last axis; its position at detection where there is none.
    void fillBox(const Analysis &analysis, const Event &event, Annotation &box)
    {
        box.startSeconds = event.onsetSeconds;
        box.endSeconds = event.endSeconds;
        if (analysis.grid().axes.size() != 1)
            return;
        box.lowHz = box.highHz = event.position.back();
        const Track *track = trackOfId(analysis.tracks, event.id);
        if (!track)
            return;
        for (const TrackPoint &point : track->points) {
            const double hz = analysis.grid().axes.back().value(double(point.cell));
            box.lowHz = std::min(*box.lowHz, hz);
            box.highHz = std::max(*box.highHz, hz);
        }
    }

    std::string labelOf(const Event &event, int signal)
    {
        std::string label = "event " + std::to_string(event.id);
        if (signal != event.id)
            label += " (of " + std::to_string(signal) + ")";
        return label;
    }

    std::vector<Row> rowsOf(const Analysis &analysis, const std::vector<Event> &events, const Annotations &annotations)
    {
        std::vector<Row> rows;
        const std::vector<EventReview> said = eventReviews(analysis, events, annotations.reviews);
        for (std::size_t i = 0; i < events.size(); ++i) {
            Row row{&events[i], said[i].signal, {}};
            fillBox(analysis, events[i], row.box);
            row.box.label = labelOf(events[i], said[i].signal);
            row.box.note = oneLine(said[i].note);
            row.box.verdict = said[i].verdict;
            rows.push_back(row);
        }
        for (const Annotation &box : annotations.boxes) {
            Row row{nullptr, 0, box};
            row.box.label = oneLine(box.label);
            row.box.note = oneLine(box.note);
            rows.push_back(row);
        }
        return rows;
    }

    std::string number(const std::optional<double> &value)
    {
        return value ? formatNumber(*value) : std::string();
    }

    std::string csv(const Grid &grid, const std::vector<Row> &rows)
    {
        const bool isLines = grid.axes.size() == 1;
        std::string text = "event,t_onset,t_detect,t_end";
        for (const Axis &axis : grid.axes)
            text += "," + (isLines ? std::string("f") : axis.name);
        text += ",drift_hz_per_s,statistic,confirmed,open";
        if (isLines)
            text += ",f_low,f_high";
        text += ",review,signal,label,note\n";
        for (const Row &row : rows) {
            const Event *e = row.event;
            text += (e ? std::to_string(e->id) : "") + "," + formatNumber(row.box.startSeconds) + ","
                    + (e ? formatNumber(e->detectSeconds) : "") + "," + formatNumber(row.box.endSeconds);
            for (std::size_t axis = 0; axis < grid.axes.size(); ++axis)
                text += "," + (e ? formatNumber(e->position[axis]) : "");
            text += "," + (e ? formatNumber(e->driftPerSecond) : "") + "," + (e ? formatNumber(e->statistic) : "") + ","
                    + (e ? (e->isConfirmed ? "1" : "0") : "") + "," + (e ? (e->isOpen ? "1" : "0") : "");
            if (isLines)
                text += "," + number(row.box.lowHz) + "," + number(row.box.highHz);
            text += "," + nameOf(row.box.verdict) + "," + (e ? std::to_string(row.signal) : "") + ","
                    + csvText(row.box.label) + "," + csvText(row.box.note) + "\n";
        }
        return text;
    }

    Json jsonOf(const Row &row, const Grid &grid)
    {
        Json json = Json::object();
        if (const Event *e = row.event) {
            json["event"] = e->id;
            json["t_onset"] = e->onsetSeconds;
            json["t_detect"] = e->detectSeconds;
            json["t_end"] = e->endSeconds;
            for (std::size_t axis = 0; axis < grid.axes.size(); ++axis)
                json[grid.axes.size() == 1 ? "f" : grid.axes[axis].name] = e->position[axis];
            json["drift_hz_per_s"] = e->driftPerSecond;
            json["statistic"] = e->statistic;
            json["confirmed"] = e->isConfirmed;
            json["open"] = e->isOpen;
            json["signal"] = row.signal;
        } else {
            json["t_onset"] = row.box.startSeconds;
            json["t_end"] = row.box.endSeconds;
        }
        if (row.box.lowHz && row.box.highHz) {
            json["f_low"] = *row.box.lowHz;
            json["f_high"] = *row.box.highHz;
        }
        json["review"] = nameOf(row.box.verdict);
        json["label"] = row.box.label;
        json["note"] = row.box.note;
        return json;
    }

    std::string json(const Analysis &analysis, const std::vector<Row> &rows)
    {
        Json json = {{"threshold", analysis.threshold},
                     {"settings", parseJson(settingsToJson(analysis.settings), "settings")}};
        json["events"] = Json::array();
        for (const Row &row : rows)
            json["events"].push_back(jsonOf(row, analysis.grid()));
        return json.dump(2) + "\n";
    }

    std::string raven(const std::vector<Row> &rows)
    {
        std::string text = "Selection\tView\tChannel\tBegin Time (s)\tEnd Time (s)\tLow Freq (Hz)\tHigh Freq "
                           "(Hz)\tAnnotation\tReview\tNotes\n";
        int selection = 0;
        for (const Row &row : rows)
            text += std::to_string(++selection) + "\tSpectrogram 1\t1\t" + formatNumber(row.box.startSeconds) + "\t"
                    + formatNumber(row.box.endSeconds) + "\t" + number(row.box.lowHz) + "\t" + number(row.box.highHz)
                    + "\t" + row.box.label + "\t" + nameOf(row.box.verdict) + "\t" + row.box.note + "\n";
        return text;
    }

    std::string audacity(const std::vector<Row> &rows)
    {
        std::string text;
        for (const Row &row : rows) {
            text += formatNumber(row.box.startSeconds) + "\t" + formatNumber(row.box.endSeconds) + "\t"
                    + annotationText(row.box.label, row.box.verdict, row.box.note) + "\n";
            if (row.box.lowHz && row.box.highHz)
                text += "\\\t" + formatNumber(*row.box.lowHz) + "\t" + formatNumber(*row.box.highHz) + "\n";
        }
        return text;
    }

    /// A box may lie anywhere; a sample's number is held in a double and in the file alike.
    long long sampleAt(double seconds, double rate)
    {
        constexpr double most = 9007199254740992.0; // 2⁵³
        return std::llround(std::clamp(seconds * rate, -most, most));
    }

    std::string sigmf(const Analysis &analysis, const std::vector<Row> &rows)
    {
        if (!analysis.recording)
            throw Error("events as SigMF", "require a recording; write .csv or .json for ready-made frames");
        const double rate = analysis.recording->info().sampleRateHz;
        const double centre = analysis.recording->info().centreHz;
        Json json;
        json["global"] = {
            {"core:version", "1.0.0"},
            {"core:sample_rate", rate},
            {"core:description", "Events found by Faintline, and what was said about them"},
            {"core:extensions", Json::array({{{"name", "faintline"}, {"version", "1.0.0"}, {"optional", true}}})}};
        json["captures"] = Json::array({{{"core:sample_start", 0}, {"core:frequency", centre}}});
        json["annotations"] = Json::array();
        for (const Row &row : rows) {
            Json one;
            const long long start = sampleAt(row.box.startSeconds, rate);
            one["core:sample_start"] = start;
            one["core:sample_count"] = std::max(1LL, sampleAt(row.box.endSeconds, rate) - start);
            if (row.box.lowHz && row.box.highHz) {
                one["core:freq_lower_edge"] = centre + *row.box.lowHz;
                one["core:freq_upper_edge"] = centre + *row.box.highHz;
            }
            one["core:label"] = row.box.label;
            one["core:comment"] = row.box.note;
            one["faintline:review"] = nameOf(row.box.verdict);
            if (row.event)
                one["faintline:statistic"] = row.event->statistic;
            json["annotations"].push_back(one);
        }
        // A SigMF reader expects them in order of time.
        std::stable_sort(json["annotations"].begin(), json["annotations"].end(),
                         [](const Json &a, const Json &b) { return a["core:sample_start"] < b["core:sample_start"]; });
        return json.dump(2) + "\n";
    }

} // namespace

void checkReviewedPath(const std::string &path)
{
    for (const char *extension : {".csv", ".json", ".txt", ".sigmf-meta"})
        if (path.ends_with(extension))
            return;
    throw Error(path, "the file name must end in .csv, .json, .selections.txt (Raven), .txt (Audacity labels) or "
                      ".sigmf-meta");
}

void writeReviewed(const Analysis &analysis, const std::vector<Event> &events, const Annotations &annotations,
                   const std::string &path)
{
    checkReviewedPath(path);
    const std::vector<Row> rows = rowsOf(analysis, events, annotations);
    if (path.ends_with(".csv"))
        writeTextFile(path, csv(analysis.grid(), rows));
    else if (path.ends_with(".json"))
        writeTextFile(path, json(analysis, rows));
    else if (path.ends_with(".selections.txt"))
        writeTextFile(path, raven(rows));
    else if (path.ends_with(".txt"))
        writeTextFile(path, audacity(rows));
    else
        writeTextFile(path, sigmf(analysis, rows));
}

} // namespace faintline
