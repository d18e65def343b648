#pragma once

#include "evaluate/theory/closedForm.h"
#include "frames/PeakPyramid.h"

#include <vector>

namespace faintline {

/// Fraction of cells in a box of a statistic's picture whose D exceeds a level, for each level of the picture's scale
/// (a quarter of a unit) down to the last level that ten cells exceed; this is the behaviour of noise in this recording
/// if the box holds nothing else. Frames begin … end-1 and cells begin … end-1 of the last axis. Examines at most 2·10⁶
/// cells, in evenly spread rows. Empty for an empty box, and if frames have been merged, because the picture then holds
/// maxima.
std::vector<ExceedancePoint> boxExceedance(const PeakPyramid &statistic, Index beginFrame, Index endFrame,
                                           Index beginCell, Index endCell);

} // namespace faintline
