#pragma once

#include "analysis/Analysis.h"

namespace faintline {

/// The tracks of the chosen window, and the lines that stand still which a longer window knows better.
///
/// A window N times as long collects 10·lg √N dB more of a line that stands still, and less of all others. So a track
/// of `longer` is taken where
///
///   1. its statistic reaches sureStatistic(longer): noise brings a hundredth of the false alarms ordered, which stay
///      what was ordered;
///   2. it moves by at most a tenth of the longer window's cell a frame, in the mean. Paths on noise, and those of
///      signals that the shorter window sees as well, move by more;
///   3. it has the larger statistic than every track of `chosen` that follows it, within a cell of the chosen window in
///      four of five of that track's frames. It takes their place: they are pieces of it;
///   4. over half of its frames or more, no other track of `chosen` comes within two of its cells. Where that track
///      moves by more than a cell within the longer window, its 5-95 % band counts.
///
/// Between the longer window's frames positions are interpolated. Statistics are shifted by the difference of the two
/// thresholds, and powers divided by the ratio of the windows, so that both mean what they mean in `chosen`. The answer
/// is numbered anew, by detection, then cell. Both analyses have tracks that were looked at from both ends
/// (secondLook.h).
std::vector<Track> withSteadyLines(const Analysis &chosen, const Analysis &longer);

} // namespace faintline
