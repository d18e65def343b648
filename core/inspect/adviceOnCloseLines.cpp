#include "inspect/advice.h"

#include "analyse/events.h"
#include "base/numberText.h"
#include "base/oneLine.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace faintline {

namespace {

    constexpr Index leastFrames = 8;
    constexpr double closeCells = 3.0;
    constexpr double wantedCells = 4.0;
    constexpr double steadyCells = 0.5; ///< standard deviation of a constant distance
    constexpr double windowsInRecording = 16.0;

    /// Distance of two tracks, in bins, over their common frames.
    struct Distance {
        double frames = 0.0;
        double mean = 0.0;
        double deviation = 0.0;
    };

    Distance distanceOf(const Track &a, const Track &b, const Axis &axis)
    {
        const Index first = std::max(a.points.front().frame, b.points.front().frame);
        const Index last = std::min(a.points.back().frame, b.points.back().frame);
        Distance distance;
        double sum = 0.0;
        double squares = 0.0;
        for (Index frame = first; frame <= last; ++frame) {
            const auto at = [&](const Track &track) { return track.lastPosition(track.pointIndex(frame), axis); };
            const double apart = at(a) - at(b);
            sum += apart;
            squares += apart * apart;
            distance.frames += 1.0;
        }
        if (distance.frames == 0.0)
            return distance;
        const double mean = sum / distance.frames;
        distance.mean = std::abs(mean);
        distance.deviation = std::sqrt(std::max(0.0, squares / distance.frames - mean * mean));
        return distance;
    }

    /// The closest pair of tracks side by side, and the number of such pairs.
    struct ClosePairs {
        int count = 0;
        double bins = 0.0;
        double position = 0.0; ///< position of the lower one, bins
    };

    ClosePairs closePairs(const std::vector<const Track *> &tracks, const Axis &axis, double binsPerCell)
    {
        ClosePairs close;
        for (std::size_t i = 0; i < tracks.size(); ++i)
            for (std::size_t j = i + 1; j < tracks.size(); ++j) {
                const Track &a = *tracks[i];
                const Track &b = *tracks[j];
                if (b.points.front().frame > a.points.back().frame)
                    break; // ordered by onset
                const Distance distance = distanceOf(a, b, axis);
                const auto shorter = double(std::min(a.points.size(), b.points.size()));
                if (2.0 * distance.frames < shorter || distance.deviation > steadyCells * binsPerCell
                    || distance.mean >= closeCells * binsPerCell)
                    continue;
                if (close.count++ == 0 || distance.mean < close.bins) {
                    close.bins = distance.mean;
                    close.position = std::min(a.lastPosition(0, axis), b.lastPosition(0, axis));
                }
            }
        return close;
    }

    std::vector<const Track *> sureTracks(const Analysis &analysis)
    {
        std::vector<const Track *> sure;
        for (const Track &track : analysis.tracks)
            if (track.windowSeconds == 0.0 // others were resolved by another window
                && statisticOf(track, analysis) >= analysis.sureStatistic() && std::ssize(track.points) >= leastFrames)
                sure.push_back(&track);
        std::sort(sure.begin(), sure.end(),
                  [](const Track *a, const Track *b) { return a->points.front().frame < b->points.front().frame; });
        return sure;
    }

    /// The steepest mean slope of the tracks, bins per frame.
    double steepestOf(const std::vector<const Track *> &tracks, const Axis &axis)
    {
        double steepest = 0.0;
        for (const Track *track : tracks) {
            const std::size_t last = track->points.size() - 1;
            steepest = std::max(steepest, std::abs(track->lastPosition(last, axis) - track->lastPosition(0, axis))
                                              / double(last));
        }
        return steepest;
    }

    std::string sentenceOf(const ClosePairs &close, const Axis &axis)
    {
        char text[160];
        const double apart = close.bins * axis.step;
        const int decimals = apart > 0.0 ? std::clamp(1 - int(std::floor(std::log10(apart))), 0, 12) : 0; // two digits
        std::snprintf(text, sizeof text, "%d pair%s of tracks %s less than 3 cells apart, e.g. %.*f %s at %s %s",
                      close.count, close.count == 1 ? "" : "s", close.count == 1 ? "runs" : "run", decimals, apart,
                      oneLine(axis.unit).c_str(), formatToStep(axis.value(close.position), axis.step, 6).c_str(),
                      oneLine(axis.unit).c_str());
        return std::string(text) + "; the window is too short to separate lines this close";
    }

} // namespace

std::optional<Advice> adviceOnCloseLines(const Analysis &analysis)
{
    const FrameGeometry geometry = analysis.frames->geometry();
    if (!geometry.isOfSpectra())
        return {};
    const Axis &axis = analysis.grid().axes.back();
    const double binsPerCell = analysis.settings.spectrogram.binsPerCell;
    const std::vector<const Track *> tracks = sureTracks(analysis);
    const ClosePairs close = closePairs(tracks, axis, binsPerCell);
    if (close.count == 0 || close.bins == 0.0)
        return {};
    const double factor = wantedCells * binsPerCell / close.bins;
    const double seconds = factor * geometry.windowSeconds;
    const double duration = double(analysis.time().count) * analysis.time().step;
    const bool isTooFast = steepestOf(tracks, axis) * factor * factor > steepestSlope(analysis.model.space);
    if (seconds * windowsInRecording > duration || isTooFast || isAsked(analysis, seconds))
        return {};
    Advice advice{"closeLines", sentenceOf(close, axis), {}, analysis.settings};
    setWindow(advice, seconds);
    return advice;
}

} // namespace faintline
