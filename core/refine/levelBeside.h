#pragma once

#include "recursion/PathStrip.h"

#include <vector>

namespace faintline {

/// Minimum level of the surroundings of a path, over the noise's: one value per frame of its strip, 1 where nothing is
/// known to raise it.
///
/// A line is isolated: at a distance of 2½ to 7 resolution cells there is noise. In a burst, a cloud or a hum that
/// spreads over many cells, the level beside a path is as high as on it. On each side, and on both together,
///
///   a(t) = 35 % quantile of y over those cells and the frames t ± n, over that of noise,
///
/// so that single lines beside the path do not count, minus 1.5 times its scatter on noise. The result is the largest
/// of these, for n = 6, 24 and 72 frames.
std::vector<double> levelBeside(const PathStrip &strip, double binsPerCell);

/// Half width in bins of the strip that levelBeside needs.
Index levelBesideHalfWidth(double binsPerCell);

/// Raised level of the surroundings of a path, as power over the noise's: one value per frame of its strip, at least 1.
///
/// An area is piecewise constant on the best dyadic partition of time. The level of a piece is the maximum-likelihood
/// one of the lower half r of its n cells (a censored exponential law), so that lines may hold the other half:
///
///   a = (Σ r lowest + (n - r)·y_r)/r,   k = r/(bins a cell · c)
///
///   and it exists if   k (a - 1 - ln a) - ½ ln k - ln(4 m) > 0
///
/// c: cells that count as one, cellLikeness; m: pieces of that length in all frames, so that 4 m is the number of choices
/// of sides and place. On noise the level is 1.00 to 1.01 in the mean. The cells are those on the left, on the right and
/// on both sides, at 2.5 to 7 resolution cells from the path, and those on both sides at n to n + 2, n = 1.5 + what the
/// path moves within a window (two frames); the largest level counts. On one side alone, a single line would fill these
/// two cells. y: without the path's own leakage.
std::vector<double> areaLevels(const PathStrip &strip, const std::vector<double> &positions, double binsPerCell,
                               double cellLikeness);

} // namespace faintline
