#pragma once

#include "base/Axis.h"

#include <vector>

namespace faintline {

/// From each block's medians over time, `columns` (blocks × cells), to backgrounds, in their place: averages of blocks,
/// smoothed over frequency.
///
/// Each block is averaged with its neighbours in time as far as the noise keeps its colour: stationary noise is known
/// better than one block tells. What the whole band's level does meanwhile is taken out; a step of more than a factor
/// of e ends the average, and so does, for each cell, more than four standard errors of a difference of two blocks'
/// `rows` (smoothed one by one), which are a median's of `framesUsed` × window cells, and of fewer toward the band's
/// edges, where the window is continued from a few of them. Cells are averaged before they are smoothed, for a running
/// median of cells that scatter errs where a slope begins. A block's lines do not count, so that a line that moves
/// slowly raises none of the cells it has been in.
void averageWhileSteady(std::vector<float> &columns, const std::vector<float> &rows, Index cells, Index half,
                        double framesUsed);

/// The same of the last block alone: a background from what came before, with the six blocks before it at most.
std::vector<float> averageOfLatest(const std::vector<float> &columns, const std::vector<float> &rows, Index cells,
                                   Index half, double framesUsed);

} // namespace faintline
