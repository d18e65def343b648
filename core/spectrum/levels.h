#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace faintline {

// How loud noise is, from cells that are exponential with lines among them, and what a series of such levels tells.
// Neighbouring cells are taken to be alike by the window's main lobe: one and a half tell as much as one.

/// √n times the deviation of the logarithm of the median of n exponential cells: 1/ln 2, rounded.
inline constexpr double inverseLn2 = 1.44;

/// The lower median; reorders the values, of which there is at least one.
float medianOf(std::vector<float> &values);

/// Mean of the lower median of n independent exponentials of mean 1: Σ 1/(n-i), i = 0 … k-1, k its rank.
double medianMean(int n);

/// Mean of the logarithm of the median of n neighbouring cells of mean 1.
double lnMedianMean(std::ptrdiff_t n);

/// Standard error of the logarithm of a median of cells.
double medianScatter(double cells);

/// Standard error of the logarithm of their `truncatedMean`, where so many neighbours tell as much as one (cellLikeness
/// in Window.h).
double meanScatter(double cells, double likeness);

/// Mean of exponential cells, from those below five times that mean, found in two steps from a first guess. As exact as
/// can be, and no line counts for more than five cells of noise.
float truncatedMean(std::span<const float> cells, float guess);

/// What a series of levels, each with an independent standard error of `scatter`, does beyond its errors.
///
/// The series is the sum of its details at scales of 1, 2, 4 … values and of what is left,
///
///   c₀ = x,  c_{j+1}(i) = ¼ c_j(i - 2ʲ) + ½ c_j(i) + ¼ c_j(i + 2ʲ),  d_j = c_j - c_{j+1},
///
/// the à trous transform with a triangle, in which a straight ramp has no details. A detail is kept as far as the mean
/// square of those about it, E, is beyond what errors make, σ_j²: by the factor 1 - σ_j²/E, and not at all where E may
/// be chance. Hence a steady level is averaged over some two hundred values, a drift over as many as it allows, and a
/// step is kept as it is. Source: Starck, Murtagh and Fadili, Sparse Image and Signal Processing, section 3.5. Cost:
/// some hundred operations a value.
std::vector<float> beyondScatter(const std::vector<float> &series, double scatter);

/// The last of a series of levels, as far as it is beyond its scatter, from that value and those before it alone: the
/// same with a one-sided transform,
///
///   c_{j+1}(i) = ½ c_j(i) + ½ c_j(i - 2ʲ),  d_j = c_j - c_{j+1},
///
/// in which c_j is the mean of the last 2ʲ values. A steady level is averaged over 128 values, if there are as many.
/// Source: Murtagh, Starck and Renaud, On neuro-wavelet modeling, Decision Support Systems 37 (2004), section 3.
float latestBeyondScatter(std::span<const float> series, double scatter);

} // namespace faintline
