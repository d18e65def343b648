#pragma once

#include "base/RunContext.h"
#include "plan/Analysis.h"

#include <vector>

namespace faintline {

// What of the tracks of a family is none: single lines, and parts of stronger families.

/// Removes the tracks of a family that a single member explains: a strong line alone at f is also a member of families
/// at f/k, or at its offsets from f, whose other members are absent.
///
/// Scores are computed in a corridor of ±3 resolution cells around each track, with the detector's own law, for
///
///   each member alone          if none reaches the threshold, no line explains the track, which is kept;
///   all but the strongest one  over the floor that it raises nearby (leakageBound). The track is kept if this reaches
///                              what noise would, in as many cells and frames, once per hundred strong lines.
///
/// Families whose members are too weak to be found alone are therefore unaffected. The remaining tracks keep their
/// order and are renumbered. Does nothing if no family is set, if one member is present at a time, or if the threshold
/// does not apply to a path score. Of tracks longer than 65536 frames only the middle is examined. Cost: the frames
/// under the tracks are computed once more. Throws Cancelled.
std::vector<Track> withoutLoneTeeth(const Analysis &analysis, std::vector<Track> tracks, const RunContext &context);

/// Removes the tracks of a family that stronger ones account for: their members coincide with some of a stronger
/// track's, for example at half or twice its fundamental, and their statistic does not exceed what these explain.
///
/// A share s of coinciding members carries at most E = s times the stronger track's statistic. A track is a signal of
/// its own if it exceeds 1.5·E and lies at least the threshold above E. The remaining tracks keep their order and are
/// renumbered. Does nothing if no family is set. Precondition: a family needs spectrogram frames.
std::vector<Track> withoutGhosts(const AnalysisPlan &plan, std::vector<Track> tracks);

} // namespace faintline
