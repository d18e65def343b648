#pragma once

#include "base/CellBox.h"
#include "base/Grid.h"

#include <span>
#include <vector>

namespace faintline {

/// Threshold crossings of one frame that belong together.
struct Cluster {
    Index peakCell = 0; ///< cell of the largest statistic (the lowest among equals)
    float peakStatistic = 0.0f;
    std::vector<Index> cells; ///< flat indices, ascending
};

/// Whether any value of a statistic exceeds a threshold, as a cluster's peak must.
bool anyAbove(std::span<const float> statistic, double threshold);

/// Groups the cells whose statistic exceeds `shoulder`: two belong together if they lie within `linkCells` of each
/// other along each axis (one number per axis), or are linked through others. Only clusters whose peak exceeds
/// `threshold` ≥ `shoulder` count; the cells between the two values are the flanks of the excursion. Exceeding is
/// strict. Ordered by peak cell. Cost: grid size, plus crossings × link box.
std::vector<Cluster> findClusters(const Grid &grid, std::span<const float> statistic, double threshold, double shoulder,
                                  const std::vector<Index> &linkCells);

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
