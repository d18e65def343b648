#pragma once

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

/// Groups the cells whose statistic exceeds `shoulder`: two belong together if they lie within `linkCells` of each
/// other along each axis (one number per axis), or are linked through others. Only clusters whose peak exceeds
/// `threshold` ≥ `shoulder` count; the cells between the two values are the flanks of the excursion. Exceeding is
/// strict. Ordered by peak cell. Cost: grid size, plus crossings × link box.
std::vector<Cluster> findClusters(const Grid &grid, std::span<const float> statistic, double threshold, double shoulder,
                                  const std::vector<Index> &linkCells);

} // namespace faintline
