#pragma once

#include "track/Track.h"

#include <vector>

namespace faintline {

/// Conditions under which two tracks are pieces of one signal.
struct JoinRule {
    double threshold = 0.0; ///< nat, the detector's
    Index largestGapFrames = 48;
    std::vector<Index> linkCells;   ///< distance that is always accepted, per axis
    std::vector<Index> reachCells;  ///< maximum move in one frame, per axis
    std::vector<Index> windowCells; ///< maximum extent of a tracker's window, per axis
    bool keepsNumbers = false;      ///< tracks keep the first piece's number; else all are renumbered
};

/// Joins each track to the one that it continues: a signal that a tracker lost for a while and the detector found
/// again.
///
/// A track that was detected n frames after another one's evidence ended continues it if
///
///   |Δcell| ≤ min(linkCells + n·reachCells, windowCells)   on every axis: it could have come from there,
///   (n - 1)·g ≤ threshold                                  g: nats per frame of the weaker of the two
///
/// for the first frame of its path for which both hold. By the second condition, the signal's absence in between is no
/// more significant than a detection must be: faint lines are joined over long gaps, a strong one that was switched off
/// is not. The later path's run-up before that frame is removed; a straight line fills the gap. Of several earlier
/// tracks the one with the shortest gap counts, then the nearest, then the first. `tracks`: ordered by detection; so is
/// the result, renumbered unless the rule keeps numbers. Cost: at most the number of tracks squared.
std::vector<Track> joinTracks(std::vector<Track> tracks, const Grid &grid, const JoinRule &rule);

/// The same incrementally: appends `track` to the one of `joined` that it continues, or adds it, in the order of
/// numbers. Returns the number of the track to which it now belongs. All tracks that it could continue, which ended
/// before it was detected, must already be in `joined`; others need not.
int joinTrack(std::vector<Track> &joined, Track track, const Grid &grid, const JoinRule &rule);

/// Whether a track that begins at `onsetFrame` or later cannot continue any that ended at `endFrame`.
inline bool isOutOfReach(Index endFrame, Index onsetFrame, const JoinRule &rule)
{
    return onsetFrame > endFrame + rule.largestGapFrames;
}

} // namespace faintline
