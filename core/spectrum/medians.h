#pragma once

#include "base/Axis.h"

#include <span>
#include <vector>

namespace faintline {

// Medians and means of many cells at once: what a background of noise is made of.

constexpr Index pivotCells = 5; ///< at a sequence's ends, about which it is continued

/// out[c] = the lower median of frames[r·cells + c] over all rows r, cells = out.size(). No value is negative or NaN.
/// Bit by bit in many columns at once, 31 comparisons a value. Oracle: std::nth_element.
void columnMedians(std::span<const float> frames, std::span<float> out);

/// Running median of a sequence over ±half, continued beyond its ends by point reflection about its robust ends.
std::vector<float> runningMedian(const std::vector<float> &sequence, Index half);

/// Weighted mean of the values within ±half, from sums up to each value: the same cost for any width. Where the weights
/// add up to less than `least`: 1.
void runningMean(std::span<const double> values, std::span<const double> weights, Index half, std::span<double> out,
                 double least = 0.5);

} // namespace faintline
