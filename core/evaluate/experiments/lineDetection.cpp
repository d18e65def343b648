#include "evaluate/experiments/lineDetection.h"

#include "analyse/events.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    constexpr double onLineCells =
        1.5; ///< of a track's distance from its line, in the window that found it or the one shown
    constexpr double missed = -std::numeric_limits<double>::infinity();

    /// Relation of a track to a line.
    enum class Bond { None, Touches, OnIt };

    Bond bondOf(const Track &track, const Analysis &analysis, const TruthLine &line)
    {
        const Axis &frequency = analysis.grid().axes.front();
        const double shown = analysis.frames->geometry().windowSeconds;
        const double window = track.windowSeconds > 0.0 ? std::min(track.windowSeconds, shown) : shown;
        const double nearHz = onLineCells / window;
        const double centreHz = analysis.recording->info().centreHz;
        int during = 0;
        int on = 0;
        bool isTouching = false;
        for (const TrackPoint &point : track.points) {
            const double seconds = analysis.time().value(double(point.frame));
            const double hz = frequency.value(double(point.cell));
            const bool isNear = std::abs(hz - (line.frequencyAt(seconds) - centreHz)) <= nearHz;
            if (seconds >= line.startSeconds && seconds <= line.endSeconds) {
                ++during;
                on += isNear ? 1 : 0;
            }
            isTouching =
                isTouching || (isNear && seconds >= line.startSeconds - window && seconds <= line.endSeconds + window);
        }
        return on > 0 && 2 * on >= during ? Bond::OnIt : isTouching ? Bond::Touches : Bond::None;
    }

} // namespace

LineDetection lineDetection(const Analysis &analysis, const TruthLine &line)
{
    LineDetection found{missed, missed, 0};
    for (const Track &track : analysis.tracks) {
        const Bond bond = bondOf(track, analysis, line);
        found.tracksBeside += bond == Bond::None ? 1 : 0;
        if (bond != Bond::OnIt)
            continue;
        const double latency = std::max(0.0, analysis.time().value(double(track.detectFrame)) - line.startSeconds);
        found.latencySeconds = found.latencySeconds < 0.0 ? latency : std::min(latency, found.latencySeconds);
        found.margin = std::max(found.margin, marginOf(statisticOf(track, analysis), analysis));
    }
    return found;
}

double marginOf(double statistic, const Analysis &analysis)
{
    // A part of a track that was split has less than the whole had.
    return std::max(statistic - analysis.threshold, double(std::numeric_limits<float>::min()));
}

} // namespace faintline
