#pragma once

#include "analysis/Analysis.h"
#include "base/RunContext.h"

#include <vector>

namespace faintline {

/// Without the tracks of a family that one of its members explains: a strong line alone, which is a member of families
/// at f/k, or at its distances from f, of which nothing else is there.
///
/// In a corridor of ±3 resolution cells around each track, with the detector's own law, scores are taken of
///
///   each member alone          where none reaches the threshold, no line explains the track: it stays;
///   all but the strongest one  over the floor that this one raises beside it (leakageBound). It stays where this
///                              reaches what noise would, in as many cells and frames, once for a hundred strong lines.
///
/// So nothing changes for families whose members are too faint to be found alone. The rest keeps its order and gets new
/// numbers. Nothing happens where no family is set, where one member is present at a time, or where the threshold is
/// not one on the score of a path. Of tracks longer than 65536 frames the middle is looked at. Cost: the frames under
/// the tracks are computed once more. Throws Cancelled.
std::vector<Track> withoutLoneTeeth(const Analysis &analysis, std::vector<Track> tracks, const RunContext &context);

} // namespace faintline
