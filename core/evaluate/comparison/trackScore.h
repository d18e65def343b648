#pragma once

#include "scene/PingTruth.h"
#include "track/Track.h"

#include <span>
#include <vector>

namespace faintline {

/// How well one target was detected and followed.
struct TargetScore {
    int tracks = 0;               ///< tracks that belong to it
    Index detectLatency = -1;     ///< pings from its first one to the first such track, counted from 1; -1: never
    Index confirmLatency = -1;    ///< the same up to the first such track's confirmation
    std::vector<double> rmsCells; ///< root mean square error along each axis, cells, over all points on the target
    Index matchedPoints = 0;
    Index presentPings = 0; ///< pings in which it fills a cell

    bool isDetected() const { return detectLatency >= 0; }
    bool isConfirmed() const { return confirmLatency >= 0; }
};

/// Result of comparing tracks with the truth.
struct TrackScore {
    std::vector<TargetScore> targets; ///< in the truth's order
    std::vector<int> targetOfTrack;   ///< index of each track's target; -1: a false track
    int falseTracks = 0;
    int falseConfirmed = 0;
};

/// A track's point lies on a target if the target's cell in that frame is within `gateCells` of it along each axis. A
/// track belongs to the target on which most of its points from detection on lie (the lowest among equals), if these
/// are at least half of its points in frames in which the target is present; otherwise it is false. Points after a
/// target's end do not count against its track.
TrackScore scoreTracks(std::span<const Track> tracks, const PingTruth &truth, const Grid &grid,
                       const std::vector<Index> &gateCells);

/// Number of latencies of 1, 2, … `longest` pings; the last element counts longer ones and missed targets (negative).
std::vector<int> latencyHistogram(std::span<const Index> latencies, Index longest);

/// Fraction of targets detected within 1, 2, … `longest` pings.
std::vector<double> pdAgainstPings(std::span<const Index> latencies, Index longest);

} // namespace faintline
