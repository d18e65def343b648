#pragma once

#include "plan/Analysis.h"

namespace faintline {

/// The tracks of the chosen window, and the steady lines that a longer window measures better.
///
/// A window N times as long gains 10·lg √N dB for a steady line, and loses for all others. So a track of `longer` is
/// taken if
///
///   1. its statistic reaches sureStatistic(longer): noise adds a hundredth of the specified false alarms, so that
///      their rate stays as specified;
///   2. it moves by at most a tenth of the longer window's cell per frame, on average. Paths on noise, and those of
///      signals that the shorter window also detects, move by more;
///   3. it stands out of its surroundings (overSides);
///   4. its statistic is larger than that of each track of `chosen` that follows it, within a cell of the chosen window
///      in four of five of that track's frames. It replaces these tracks, which are pieces of it;
///   5. over at least half of its frames, no other track of `chosen` comes within two of its cells. If that track moves
///      by more than a cell within the longer window, its 5-95 % band counts.
///
/// Positions are interpolated between the longer window's frames. Statistics are shifted by the difference of the two
/// thresholds, and powers divided by the ratio of the windows, so that both have the same meaning as in `chosen`. The
/// result is renumbered, by detection, then cell. Both analyses must have two-sided tracks (secondLook.h). Throws
/// Cancelled.
std::vector<Track> withSteadyLines(const Analysis &chosen, const Analysis &longer, const RunContext &context = {});

} // namespace faintline
