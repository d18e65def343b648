#pragma once

#include "track/PathStrip.h"

#include <vector>

namespace faintline {

/// The least level of what a path runs through, over the noise's: one value a frame of its strip, 1 where nothing is
/// known to raise it.
///
/// A line stands alone: 2½ to 7 resolution cells beside it there is noise. In a burst, a cloud or a hum that spreads
/// over many cells there is as much beside a path as on it. On either side, and of both,
///
///   a(t) = 35 % quantile of y over those cells and the frames t ± n, over that of noise,
///
/// so that single lines beside the path do not count, less 1.5 times the scatter it has on noise. The answer is the
/// largest of these, for n = 6, 24 and 72 frames.
std::vector<double> levelBeside(const PathStrip &strip, double binsPerCell);

/// Half-width of a strip that this needs, in bins.
Index levelBesideHalfWidth(double binsPerCell);

} // namespace faintline
