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

/// Level on the sides of a line that stands still, as power over the noise's: the larger of both sides, at least 1.
///
/// The main lobe is 15 dB down at 1½ resolution cells (Hann), so from there to 3½ cells there is noise, or a wider
/// signal that includes the path. A side's level is exp(mean of ln y + γ) over its observed cells, with Euler's
/// constant γ. For exponential cells this is their mean, and single high cells hardly change it.
double levelOfSides(const PathStrip &strip, double binsPerCell);

/// Mean signal power on the weaker side of a line that stands still, as a share of that on its path:
/// (ȳ_side - 1)/(ȳ_path - 1), at least 0; 0 with fewer than 8 values on a side or on the path.
///
/// The side lobes of a line give 0.03. In a wider signal whose power comes in bursts, levelOfSides is far below the
/// mean, but the bursts raise path and sides alike. A stronger neighbour on one side does not count.
///
/// `sides`: the same strip, without the cells of other signals.
double shareOfSides(const PathStrip &line, const PathStrip &sides, double binsPerCell);

/// Half width in bins of the strip that levelOfSides and shareOfSides need.
Index levelOfSidesHalfWidth(double binsPerCell);

} // namespace faintline
