#pragma once

#include "evaluate/theory/closedForm.h"
#include "spectrum/PeakPyramid.h"

#include <vector>

namespace faintline {

/// The share of cells in a box of a statistic's picture whose D exceeds a level, level by level of the picture's scale
/// (a quarter of a unit), down to the last level that ten cells exceed: what noise does in this recording, where the
/// box holds nothing else. Frames begin … end-1 and cells begin … end-1 of the last axis. Looks at no more than 2·10⁶
/// cells, in rows spread evenly. Empty for an empty box, and where frames have been merged: the picture then holds
/// maxima.
std::vector<ExceedancePoint> boxExceedance(const PeakPyramid &statistic, Index beginFrame, Index endFrame,
                                           Index beginCell, Index endCell);

} // namespace faintline
