#pragma once

#include "base/RunContext.h"
#include "plan/Analysis.h"

#include <vector>

namespace faintline {

/// Removes the tracks of a family that single lines or stronger families explain: a line at f is also a member of
/// families at f/k, or at its offsets from f, and those at half or twice a fundamental have some of its members.
///
/// Each track, or each piece of one of more than 4096 frames, is asked in its members' own frames of single lines, the
/// strongest first, in a corridor of ±¾ resolution cell, over the floor of what is explained so far (Explanations).
/// Within a cell of that, members are not observed.
///
///   ghost   if less than 8 % of its statistic remains over the floor, as of lines (refine/secondLook.h), it is dropped
///   line    its strongest member, if the score of that alone reaches the threshold, is explained from now on; not if one
///           member is present at a time
///   family  if nothing raises its floor, or its members then reach the threshold over it, the track is kept, and its
///           members are explained from now on
///
/// Families whose members are too weak to be found alone, and apart from others, are therefore unaffected. The
/// remaining tracks keep their order and are renumbered. Does nothing if no family is set. Cost: the frames under the
/// tracks are computed once more. Throws Cancelled.
std::vector<Track> familiesOfTheirOwn(const Analysis &analysis, std::vector<Track> tracks, const RunContext &context);

} // namespace faintline
