#include "refine/subtractLines.h"

#include "base/Field.h"
#include "base/logmath.h"
#include "noise/SurrogateRecording.h"
#include "refine/constants.h"
#include "refine/smoothFrequency.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace faintline {

namespace {

    double meanLevel(const Track &track)
    {
        double sum = 0.0;
        for (const SmoothedPoint &point : track.smoothed)
            sum += double(point.level);
        return sum / double(std::max<std::size_t>(1, track.smoothed.size()));
    }

    /// Removes the track's ends, whose windows hold less of the line than of its abrupt onset or of noise. The curve is
    /// later extended straight from the rest.
    Track middleOf(const Track &track, Index endFrames)
    {
        const Index cut = std::min(endFrames, std::ssize(track.points) / 4);
        Track middle = track;
        middle.keepPoints(std::size_t(cut), track.points.size() - std::size_t(cut));
        return middle;
    }

    LinePath pathOf(const AnalysisPlan &plan, const Track &track)
    {
        const double window = plan.frames->geometry().windowSeconds;
        const auto endFrames = Index(std::lround(subtractedEndWindows * window / plan.time().step));
        const auto secondsAt = [&](const TrackPoint &point) { return plan.time().value(double(point.frame)); };
        return {smoothFrequency(plan, middleOf(track, endFrames), subtractedSmoothWindows * window),
                secondsAt(track.points.front()), secondsAt(track.points.back()), window};
    }

} // namespace

std::vector<Track> tracksToSubtract(const Analysis &analysis)
{
    const double least = ratioFromDb(analysis.settings.subtract.leastDb);
    std::vector<Track> strong;
    for (const Track &track : analysis.tracks)
        if (meanLevel(track) >= least) {
            strong.push_back(track);
            strong.back().isSubtracted = true;
        }
    return strong;
}

std::vector<LinePath> pathsOf(const AnalysisPlan &plan, std::vector<Track> tracks)
{
    std::stable_sort(tracks.begin(), tracks.end(),
                     [](const Track &a, const Track &b) { return meanLevel(a) > meanLevel(b); });
    std::vector<LinePath> paths;
    for (const Track &track : tracks)
        paths.push_back(pathOf(plan, track));
    return paths;
}

RecordingPointer restOf(const AnalysisPlan &plan, std::vector<Track> tracks, const RunContext &context)
{
    constexpr std::uint64_t seed = 4711; // the noise only has to differ from the recording's own
    const int channel = plan.settings.selection.channel;
    const SurrogateRecording noise(plan.recording, channel, plan.frames->geometry().windowSamples, plan.background,
                                   seed);
    return std::make_shared<ResidualRecording>(plan.recording, channel, pathsOf(plan, std::move(tracks)), &noise,
                                               context);
}

std::string subtractionWords(const Analysis &analysis)
{
    if (!analysis.settings.subtract.lines)
        return {};
    const std::string least = formatNumber(analysis.settings.subtract.leastDb) + " dB";
    Index count = 0;
    double strongest = 0.0;
    for (const Track &track : analysis.tracks)
        if (track.isSubtracted) {
            ++count;
            strongest = std::max(strongest, meanLevel(track));
        }
    if (count == 0)
        return "no line of " + least + " or more to subtract";
    char text[160];
    std::snprintf(text, sizeof text,
                  "%td line%s of %s or more subtracted, up to %.1f dB; all other events are in the rest", count,
                  count == 1 ? "" : "s", least.c_str(), dbFromRatio(strongest));
    return text;
}

} // namespace faintline
