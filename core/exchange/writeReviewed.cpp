#include "exchange/writeReviewed.h"

#include "base/files/AtomicFile.h"
#include "base/oneLine.h"
#include "exchange/csvText.h"
#include "exchange/reviewedText.h"
#include "exchange/writeEvents.h"

#include <algorithm>

namespace faintline {

namespace {

    std::string labelOf(const Event &event, int signal, const std::string &given)
    {
        if (!given.empty())
            return oneLine(given);
        std::string label = "event " + std::to_string(event.id);
        if (signal != event.id)
            label += " (of " + std::to_string(signal) + ")";
        return label;
    }

    /// What was drawn by hand stands beside what was measured, and takes its place nowhere.
    void addDrawn(const EventReview &said, const Analysis &analysis, std::vector<ReviewedRow> &rows)
    {
        for (const SignalPath &piece : said.drawn) {
            ReviewedRow row{nullptr, said.signal, rows.back().box};
            row.box.label += " (drawn)";
            row.box.startSeconds = piece.seconds.front();
            row.box.endSeconds = piece.seconds.back();
            if (analysis.grid().isSpectrum()) {
                const auto [low, high] = std::ranges::minmax_element(piece.position);
                row.box.lowHz = low->back();
                row.box.highHz = high->back();
            }
            rows.push_back(row);
        }
    }

    std::vector<ReviewedRow> rowsOf(const Analysis &analysis, const std::vector<Event> &events,
                                    const Annotations &annotations)
    {
        std::vector<ReviewedRow> rows;
        const std::vector<EventReview> said = eventReviews(analysis, events, annotations.reviews);
        for (std::size_t i = 0; i < events.size(); ++i) {
            ReviewedRow row{&events[i], said[i].signal, {}};
            fillBox(analysis, events[i], row.box);
            row.box.label = labelOf(events[i], said[i].signal, said[i].label);
            row.box.note = oneLine(said[i].note);
            row.box.verdict = said[i].verdict;
            rows.push_back(row);
            addDrawn(said[i], analysis, rows);
        }
        for (const Annotation &box : annotations.boxes) {
            ReviewedRow row{nullptr, 0, box};
            row.box.label = oneLine(box.label);
            row.box.note = oneLine(box.note);
            rows.push_back(row);
        }
        return rows;
    }

    std::string csv(const Analysis &analysis, const std::vector<ReviewedRow> &rows)
    {
        const auto columns = eventColumns(analysis.grid(), OptionalColumns::of(analysis));
        const bool hasBand = analysis.grid().isSpectrum();
        std::string text = csvNames(columns) + (hasBand ? ",f_low,f_high" : "") + ",review,signal,label,note\n";
        for (const ReviewedRow &row : rows) {
            const Event *e = row.event;
            text += csvLine(columns, [&](const TableColumn<Event> &column) {
                return e                          ? cellText(column.value(*e))
                       : column.name == "t_onset" ? formatNumber(row.box.startSeconds)
                       : column.name == "t_end"   ? formatNumber(row.box.endSeconds)
                                                  : std::string();
            });
            if (hasBand)
                text += ',' + numberOrEmpty(row.box.lowHz) + "," + numberOrEmpty(row.box.highHz);
            text += ',' + nameOf(row.box.verdict) + "," + (row.signal > 0 ? std::to_string(row.signal) : "") + ","
                    + csvText(row.box.label) + "," + csvText(row.box.note) + "\n";
        }
        return text;
    }

    Json jsonOfRow(const ReviewedRow &row, const Analysis &analysis)
    {
        Json json = Json::object();
        if (row.event) {
            json = eventJson(*row.event, analysis);
        } else {
            json["t_onset"] = row.box.startSeconds;
            json["t_end"] = row.box.endSeconds;
        }
        if (row.signal > 0)
            json["signal"] = row.signal;
        if (row.box.lowHz && row.box.highHz) {
            json["f_low"] = *row.box.lowHz;
            json["f_high"] = *row.box.highHz;
        }
        json["review"] = nameOf(row.box.verdict);
        json["label"] = row.box.label;
        json["note"] = row.box.note;
        return json;
    }

    std::string json(const Analysis &analysis, const std::vector<ReviewedRow> &rows)
    {
        Json json = {{"threshold", analysis.threshold},
                     {"settings", parseJson(settingsToJson(analysis.settings), "settings")}};
        json["events"] = Json::array();
        for (const ReviewedRow &row : rows)
            json["events"].push_back(jsonOfRow(row, analysis));
        return json.dump(2) + "\n";
    }

    std::string sigmf(const Analysis &analysis, const std::vector<ReviewedRow> &rows)
    {
        if (!analysis.recording)
            throw Error("events as SigMF", "require a recording; write .csv or .json for ready-made frames");
        return sigmfText(rows, analysis.recording->info());
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

std::string reviewedSigmf(const Analysis &analysis, const std::vector<Event> &events, const Annotations &annotations)
{
    return sigmf(analysis, rowsOf(analysis, events, annotations));
}

std::string reviewedJson(const Analysis &analysis, const std::vector<Event> &events, const Annotations &annotations)
{
    return json(analysis, rowsOf(analysis, events, annotations));
}

void writeReviewed(const Analysis &analysis, const std::vector<Event> &events, const Annotations &annotations,
                   const std::string &path)
{
    checkReviewedPath(path);
    const std::vector<ReviewedRow> rows = rowsOf(analysis, events, annotations);
    if (path.ends_with(".csv"))
        writeTextFile(path, csv(analysis, rows));
    else if (path.ends_with(".json"))
        writeTextFile(path, json(analysis, rows));
    else if (path.ends_with(".selections.txt"))
        writeTextFile(path, ravenText(rows));
    else if (path.ends_with(".txt"))
        writeTextFile(path, audacityText(rows));
    else
        writeTextFile(path, sigmf(analysis, rows));
}

} // namespace faintline
