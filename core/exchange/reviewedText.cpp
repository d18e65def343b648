#include "exchange/reviewedText.h"

#include "base/Field.h"
#include "base/json.h"
#include "exchange/annotationText.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// A box may lie anywhere; the sample number must be exact as a double, here and in the file.
    long long sampleAt(double seconds, double rate)
    {
        constexpr double most = 9007199254740992.0; // 2⁵³
        return std::llround(std::clamp(seconds * rate, -most, most));
    }

} // namespace

void fillBox(const Analysis &analysis, const Event &event, Annotation &box)
{
    box.startSeconds = event.onsetSeconds;
    box.endSeconds = event.endSeconds;
    if (!analysis.grid().isSpectrum())
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

std::string numberOrEmpty(const std::optional<double> &value)
{
    return value ? formatNumber(*value) : std::string();
}

std::string ravenText(const std::vector<ReviewedRow> &rows)
{
    std::string text = "Selection\tView\tChannel\tBegin Time (s)\tEnd Time (s)\tLow Freq (Hz)\tHigh Freq "
                       "(Hz)\tAnnotation\tReview\tNotes\n";
    int selection = 0;
    for (const ReviewedRow &row : rows)
        text += std::to_string(++selection) + "\tSpectrogram 1\t1\t" + formatNumber(row.box.startSeconds) + "\t"
                + formatNumber(row.box.endSeconds) + "\t" + numberOrEmpty(row.box.lowHz) + "\t"
                + numberOrEmpty(row.box.highHz) + "\t" + row.box.label + "\t" + nameOf(row.box.verdict) + "\t"
                + row.box.note + "\n";
    return text;
}

std::string audacityText(const std::vector<ReviewedRow> &rows)
{
    std::string text;
    for (const ReviewedRow &row : rows) {
        text += formatNumber(row.box.startSeconds) + "\t" + formatNumber(row.box.endSeconds) + "\t"
                + annotationText(row.box.label, row.box.verdict, row.box.note) + "\n";
        if (row.box.lowHz && row.box.highHz)
            text += "\\\t" + formatNumber(*row.box.lowHz) + "\t" + formatNumber(*row.box.highHz) + "\n";
    }
    return text;
}

std::string sigmfText(const std::vector<ReviewedRow> &rows, double rate, double centre)
{
    Json json;
    json["global"] = {
        {"core:version", "1.0.0"},
        {"core:sample_rate", rate},
        {"core:description", "Events found by Faintline, with their reviews"},
        {"core:extensions", Json::array({{{"name", "faintline"}, {"version", "1.0.0"}, {"optional", true}}})}};
    json["captures"] = Json::array({{{"core:sample_start", 0}, {"core:frequency", centre}}});
    json["annotations"] = Json::array();
    for (const ReviewedRow &row : rows) {
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
    // SigMF requires annotations in order of time.
    std::stable_sort(json["annotations"].begin(), json["annotations"].end(),
                     [](const Json &a, const Json &b) { return a["core:sample_start"] < b["core:sample_start"]; });
    return json.dump(2) + "\n";
}

} // namespace faintline
