#pragma once

#include "frames/Window.h"
#include "recursion/PathStrip.h"

#include <vector>

namespace faintline {

/// A strip over the leakage of the line itself: y/(1 + r |W(d)|²), r: its level in each frame, d: the distance from it.
PathStrip withoutLine(PathStrip strip, const std::vector<double> &positions, const std::vector<double> &levels,
                      WindowShape window, double binsPerCell);

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

/// Factor V(n) ≥ 1 by which the variance of means over n successive frames exceeds that of independent cells, beside a
/// path: what raises the power of a cloud, a hum or speckle stays for several frames, so that a path through it gathers
/// evidence that is not its own (OwnNoiseLaw has the law of the whole recording).
///
///   k = 2 (0.6745/m)² + ¼      m: median of |ln(b/a)|, of means a, b over L frames, one after the other in one bin
///   V(n) = max over L = 2, 4, 8 … ≤ n of L/(o k)/(1 + 2 s),   at least 1
///
/// k is the shape of the gamma law of which two values differ by e^m or less with probability ½, to 2 % from k = 1 on,
/// to 8 % at ½. As a median over bins and times it does not see lines that lie beside the path or cross it, and as one
/// of differences, neither do slow changes of level or those from bin to bin: these are areas. o: the overlap's factor on
/// the variance of means, overlapFactor². s: relative standard error of k, 2.33/√N for N independent pairs, of which
/// neighbouring ones count ⅔; so V is the lower end of its 95 % interval. The bins are those at 2.5 to 7 resolution
/// cells, or farther by what the path moves in a window. y: without the path's own leakage. At most 32 frames are
/// averaged, and a sixth of all, so that an onset and an end beside are a minority of the differences.
double runsBeside(const PathStrip &strip, const std::vector<double> &positions, Index n, double binsPerCell,
                  double cellLikeness, double overlap);

} // namespace faintline
