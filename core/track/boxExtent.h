#pragma once

#include "detect/Detector.h"

#include <span>
#include <vector>

namespace faintline {

// How far the box around a track reaches, in which the detector is inhibited or reset: as far as other tracks would
// start from the same signal.

/// The box extended along the last axis over the skirts of a modulated line at its centre, which reach beyond the
/// window's own side lobes: down the hill of y on either side, in steps of `step` cells, as long as the largest y of a
/// step does not rise and is at least 8, which noise rarely exceeds; at most 16 steps. Unchanged if `step` is 0 or y at
/// the centre is less than 8. `y`: a frame on the grid.
CellBox overSkirts(CellBox box, const Grid &grid, std::span<const float> y, Index step);

/// The box extended about its centre so that it contains `cells` and `margin` cells beyond them, per axis.
CellBox overCells(CellBox box, const Grid &grid, std::span<const Index> cells, const std::vector<Index> &margin);

} // namespace faintline
