#include "inspect/advice.h"

#include "analyse/events.h"
#include "base/driftWords.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr Index trackFrames = 8;
    constexpr double shareOfTracks = 0.05; ///< of the frames of all sure tracks

    /// Whether a track's slope is that steep in more than half of its frames, or from its first to its last one: the
    /// pieces of a line that is too fast for the model may have been joined to one track.
    bool keepsTo(const Track &track, double slope, const StateSpace &space)
    {
        const TrackPoint &first = track.points.front();
        const TrackPoint &last = track.points.back();
        if (std::abs(double(last.cell - first.cell)) >= slope * double(last.frame - first.frame))
            return true;
        const auto steep = std::count_if(track.points.begin(), track.points.end(), [&](const TrackPoint &point) {
            return std::abs(space.ratesOfPlane(point.plane).back()) >= slope;
        });
        return 2 * steep > std::ssize(track.points);
    }

    /// Number of sure tracks with that slope; 0 if their frames are too small a share of all sure tracks'.
    int tracksAt(double slope, const Analysis &analysis)
    {
        int tracks = 0;
        std::ptrdiff_t frames = 0;
        std::ptrdiff_t all = 0;
        for (const Track &track : analysis.tracks) {
            const auto length = std::ssize(track.points);
            if (statisticOf(track, analysis) < analysis.sureStatistic() || length < trackFrames)
                continue;
            all += length;
            if (!keepsTo(track, slope, analysis.model.space))
                continue;
            ++tracks;
            frames += length;
        }
        return double(frames) >= shareOfTracks * double(all) ? tracks : 0;
    }

} // namespace

double steepestSlope(const StateSpace &space)
{
    double steepest = 0.0;
    for (Index plane = 0; plane < space.planeCount(); ++plane)
        steepest = std::max(steepest, std::abs(space.ratesOfPlane(plane).back()));
    return steepest;
}

std::optional<Advice> adviceOnSlopes(const Analysis &analysis)
{
    const FrameGeometry geometry = analysis.frames->geometry();
    const double steepest = steepestSlope(analysis.model.space);
    if (!geometry.isOfSpectra() || steepest == 0.0 || isAsked(analysis, geometry.windowSeconds / 2.0))
        return {};
    const int fast = tracksAt(steepest, analysis);
    if (fast == 0)
        return {};
    const double hzPerSecond = steepest * analysis.grid().axes.back().step / analysis.time().step;
    Advice advice{"slopeLimit",
                  std::to_string(fast) + (fast == 1 ? " track drifts" : " tracks drift")
                      + " as fast as the model allows, " + driftWords(hzPerSecond)
                      + "; lines that drift faster are lost or cut",
                  {},
                  analysis.settings};
    setWindow(advice, geometry.windowSeconds / 2.0);
    return advice;
}

} // namespace faintline
