#pragma once

#include "base/Axis.h"

#include <vector>

namespace faintline {

/// Replaces each block's medians over time, `columns` (blocks × cells), by a background: averaged over blocks and
/// smoothed over frequency.
///
/// Each block is averaged with its neighbours in time as far as the noise keeps its colour, because an average
/// estimates stationary noise better than one block. Level changes of the whole band are removed first. The average
/// ends at a step of more than a factor of e, and for each cell at a difference of more than four standard errors
/// between the `rows` (smoothed individually) of two blocks; the error is that of a median of `framesUsed` × window
/// cells, and of fewer toward the band's edges, where the window is extended from a few of them. Cells are averaged
/// before they are smoothed, because a running median of noisy cells is biased where a slope begins. A block's lines do
/// not count, so that a slowly moving line does not raise the cells it has passed.
void averageWhileSteady(std::vector<float> &columns, const std::vector<float> &rows, Index cells, Index half,
                        double framesUsed);

/// Background of the last block alone, averaged with at most six blocks before it.
std::vector<float> averageOfLatest(const std::vector<float> &columns, const std::vector<float> &rows, Index cells,
                                   Index half, double framesUsed);

} // namespace faintline
