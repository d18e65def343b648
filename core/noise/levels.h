#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace faintline {

// Estimators of the level of noise from exponential cells that may contain lines, and of changes in a series of levels.
// Neighbouring cells are assumed to be correlated by the window's main lobe: 1.5 cells count as one.

/// The lower median; reorders the values. Precondition: not empty.
float medianOf(std::vector<float> &values);

/// The same of values that are not negative; fast if they are exponential with a median near the expected one, which is
/// positive. Counts the values below a few limits, in vectors, and does not move them.
float exponentialMedian(std::span<const float> values, float expected);

/// Mean of the lower median of n independent exponentials of mean 1: Σ 1/(n-i), i = 0 … k-1, k its rank.
double medianMean(int n);

/// Standard error of the logarithm of a median of cells.
double medianScatter(double cells);

/// Standard error of the logarithm of the cells' `truncatedMean`, where `likeness` neighbours count as one
/// (cellLikeness in Window.h).
double meanScatter(double cells, double likeness);

/// Mean of exponential cells from those below five times that mean, found in two steps from a first guess. It is nearly
/// efficient, and a line counts for at most five cells of noise.
float truncatedMean(std::span<const float> cells, float guess);

/// Significant part of a series of levels, each with an independent standard error of `scatter`.
///
/// The series is the sum of its details at scales of 1, 2, 4 … values and a remainder,
///
///   c₀ = x,  c_{j+1}(i) = ¼ c_j(i - 2ʲ) + ½ c_j(i) + ¼ c_j(i + 2ʲ),  d_j = c_j - c_{j+1},
///
/// the à trous transform with a triangle, in which a straight ramp has no details. With E the mean square of
/// neighbouring details and σ_j² that due to errors, a detail is multiplied by 1 - σ_j²/E, and by 0 where E may be due
/// to chance. Hence a steady level is averaged over some two hundred values, a drift over as many as it allows, and a
/// step is kept unchanged. Source: Starck, Murtagh and Fadili, Sparse Image and Signal Processing, section 3.5. Cost:
/// some hundred operations per value.
std::vector<float> beyondScatter(const std::vector<float> &series, double scatter);

/// Significant part of the last of a series of levels, from that value and previous ones alone: the same with a
/// one-sided transform,
///
///   c_{j+1}(i) = ½ c_j(i) + ½ c_j(i - 2ʲ),  d_j = c_j - c_{j+1},
///
/// in which c_j is the mean of the last 2ʲ values. A steady level is averaged over up to 128 values. Source: Murtagh,
/// Starck and Renaud, On neuro-wavelet modeling, Decision Support Systems 37 (2004), section 3.
float latestBeyondScatter(std::span<const float> series, double scatter);

} // namespace faintline
