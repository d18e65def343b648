#pragma once

#include "plan/Analysis.h"

#include <span>
#include <vector>

namespace faintline {

/// Those of `lines`, which stand still, that stand out of their surroundings.
///
/// A band of a few cells has a path as good as a line's. So the detector's score of the strongest path within a cell of
/// the track, with y divided by the level on its sides (levelOfSides), has to reach sureStatistic(analysis), and the
/// weaker side must not have more than a quarter of the path's mean power over the noise's (shareOfSides). Cells within
/// a cell of `all` tracks of this analysis do not belong to the sides.
///
/// The levels of levelBeside do not decide this: they are those of cells farther away, over fewer frames, and less
/// their scatter.
///
/// Frames are read again if there are any lines, for 64 MiB of cells around them at a time. Throws Cancelled.
std::vector<Track> overSides(const Analysis &analysis, std::vector<Track> lines, std::span<const Track> all,
                             const RunContext &context);

} // namespace faintline
