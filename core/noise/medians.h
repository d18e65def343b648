#pragma once

#include "base/Axis.h"

#include <span>
#include <vector>

namespace faintline {

// Medians and means of many cells at once, for noise backgrounds.

/// out[c] = the lower median of frames[r·cells + c] over all rows r, cells = out.size(). Precondition: no value is
/// negative or NaN. Works bit by bit in many columns at once, 31 comparisons per value. Oracle: std::nth_element.
void columnMedians(std::span<const float> frames, std::span<float> out);

/// The largest of values that are not negative; 0 if there are none.
float largest(std::span<const float> values);

/// Running median of a sequence over ±half, extended beyond its ends by point reflection about its robust ends.
std::vector<float> runningMedian(const std::vector<float> &sequence, Index half);

/// Weighted mean of the values within ±half, computed from cumulative sums, so the cost does not depend on the width. 1
/// where the weights add up to less than `least`.
void runningMean(std::span<const double> values, std::span<const double> weights, Index half, std::span<double> out,
                 double least = 0.5);

} // namespace faintline
