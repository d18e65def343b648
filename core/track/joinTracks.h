#pragma once

#include "track/Track.h"

#include <vector>

namespace faintline {

/// When two tracks are pieces of one signal.
struct JoinRule {
    double threshold = 0.0; ///< nat, the detector's
    Index largestGapFrames = 48;
    std::vector<Index> linkCells;   ///< nearness that needs no explanation, per axis
    std::vector<Index> reachCells;  ///< farthest move in one frame, per axis
    std::vector<Index> windowCells; ///< farthest a tracker looks, per axis
    bool keepsNumbers = false;      ///< of the first piece; else all are numbered anew
};

/// Joins each track to the one that it continues: a signal that a tracker lost for a while and the detector found
/// again.
///
/// A track that was detected after another one's evidence had ended, n frames later, continues it if
///
///   |Δcell| ≤ min(linkCells + n·reachCells, windowCells)   on every axis: it could have come from there,
///   (n - 1)·g ≤ threshold                                  g: nats a frame the weaker of the two gathered
///
/// for the first frame of its path for which both hold. The second says that the signal's absence in between is no more
/// significant than a detection has to be: faint lines are joined over long gaps, a strong one that was switched off is
/// not. The later path's run-up before that frame goes; the gap is filled by a straight line. Of several earlier
/// tracks the one with the shortest gap counts, then the nearest, then the first.
/// `tracks`: ordered by detection; so is the answer, numbered anew unless the rule keeps numbers. Cost: number of
/// tracks squared, at most.
std::vector<Track> joinTracks(std::vector<Track> tracks, const Grid &grid, const JoinRule &rule);

/// The same one by one: `track` goes behind the one of `joined` that it continues, or comes to them, in the order of
/// their numbers. Answers the number of the track that it is part of now. Those that it could continue, which ended
/// before it was detected, have to be there already; others need not.
int joinTrack(std::vector<Track> &joined, Track track, const Grid &grid, const JoinRule &rule);

/// Whether a track that begins at a frame, or later, can continue none that ended there.
inline bool isOutOfReach(Index endFrame, Index onsetFrame, const JoinRule &rule)
{
    return onsetFrame > endFrame + rule.largestGapFrames;
}

} // namespace faintline
