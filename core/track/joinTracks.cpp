#include "track/joinTracks.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace faintline {

namespace {

    /// Mean gain of a track, nats per frame.
    double growth(const Track &track)
    {
        return track.peakStatistic / double(track.points.size());
    }

    /// Point at which a later track continues an earlier one.
    struct Joint {
        std::size_t point = 0; ///< of the later track
        Index gapFrames = 0;
        Index distance = 0; ///< largest over the axes, cells
        bool isFound = false;
    };

    Joint jointOf(const Track &earlier, const Track &later, const Grid &grid, const JoinRule &rule)
    {
        const TrackPoint &end = earlier.points.back();
        const std::vector<Index> from = grid.coordinates(end.cell);
        const double weaker = std::min(growth(earlier), growth(later));
        Joint joint;
        for (std::size_t i = 0; i < later.points.size() && later.points[i].frame <= later.detectFrame; ++i) {
            joint.gapFrames = later.points[i].frame - end.frame;
            if (joint.gapFrames < 1)
                continue;
            if (joint.gapFrames > rule.largestGapFrames || double(joint.gapFrames - 1) * weaker > rule.threshold)
                return {};
            const std::vector<Index> to = grid.coordinates(later.points[i].cell);
            joint.distance = 0;
            joint.isFound = true;
            for (std::size_t axis = 0; axis < to.size(); ++axis) {
                const Index steps = std::abs(grid.axes[axis].steps(from[axis], to[axis]));
                joint.isFound = joint.isFound
                                && steps <= std::min(rule.linkCells[axis] + joint.gapFrames * rule.reachCells[axis],
                                                     rule.windowCells[axis]);
                joint.distance = std::max(joint.distance, steps);
            }
            joint.point = i;
            if (joint.isFound)
                return joint;
        }
        return {};
    }

    /// Appends the later track's points from the joint on to the earlier one, with a straight line between.
    void append(Track &earlier, const Track &later, const Joint &joint, const Grid &grid)
    {
        const TrackPoint end = earlier.points.back();
        const TrackPoint &next = later.points[joint.point];
        const std::vector<Index> from = grid.coordinates(end.cell);
        const std::vector<Index> to = grid.coordinates(next.cell);
        for (Index i = 1; i < joint.gapFrames; ++i) {
            std::vector<Index> c = from;
            for (std::size_t axis = 0; axis < c.size(); ++axis) {
                const double share = double(i) / double(joint.gapFrames);
                const auto steps = std::llround(share * double(grid.axes[axis].steps(from[axis], to[axis])));
                c[axis] = grid.axes[axis].wrapped(from[axis] + Index(steps));
            }
            earlier.points.push_back({end.frame + i, grid.cell(c), next.plane, end.statistic});
        }
        earlier.points.insert(earlier.points.end(), later.points.begin() + std::ptrdiff_t(joint.point),
                              later.points.end());
        if (const std::size_t model = modelAt(next.frame, later.model, later.modelChanges);
            model != earlier.lastModel())
            earlier.modelChanges.push_back({end.frame + 1, model});
        for (const ModelChange &change : later.modelChanges)
            if (change.frame > next.frame)
                earlier.modelChanges.push_back(change);
        earlier.endFrame = later.endFrame;
        earlier.detectStatistic = std::max(earlier.detectStatistic, later.detectStatistic);
        earlier.peakStatistic = std::max(earlier.peakStatistic, later.peakStatistic);
        earlier.isConfirmed = earlier.isConfirmed || later.isConfirmed;
        earlier.isOpen = later.isOpen;
    }

} // namespace

int joinTrack(std::vector<Track> &joined, Track track, const Grid &grid, const JoinRule &rule)
{
    Track *best = nullptr;
    Joint joint;
    for (Track &earlier : joined) {
        if (earlier.endFrame >= track.detectFrame || isOutOfReach(earlier.endFrame, track.onsetFrame, rule))
            continue;
        const Joint candidate = jointOf(earlier, track, grid, rule);
        const bool isBetter = !best || candidate.gapFrames < joint.gapFrames
                              || (candidate.gapFrames == joint.gapFrames && candidate.distance < joint.distance);
        if (candidate.isFound && isBetter) {
            best = &earlier;
            joint = candidate;
        }
    }
    if (best) {
        append(*best, track, joint, grid);
        return best->id;
    }
    const int id = track.id;
    const auto behind =
        std::find_if(joined.rbegin(), joined.rend(), [id](const Track &earlier) { return earlier.id <= id; });
    joined.insert(behind.base(), std::move(track));
    return id;
}

std::vector<Track> joinTracks(std::vector<Track> tracks, const Grid &grid, const JoinRule &rule)
{
    std::vector<Track> joined;
    for (Track &track : tracks)
        joinTrack(joined, std::move(track), grid, rule);
    for (std::size_t i = 0; i < joined.size() && !rule.keepsNumbers; ++i)
        joined[i].id = int(i) + 1;
    return joined;
}

} // namespace faintline
