#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace faintline {

// How loud noise is, from cells that are exponential with lines among them, and what a series of such levels tells.
// Neighbouring cells are taken to be alike by the window's main lobe: one and a half tell as much as one.

/// The lower median; reorders the values, of which there is at least one.
float medianOf(std::vector<float> &values);

/// Mean of the lower median of n independent exponentials of mean 1: Σ 1/(n-i), i = 0 … k-1, k its rank.
double medianMean(int n);

/// Mean of the logarithm of the median of n neighbouring cells of mean 1.
double lnMedianMean(std::ptrdiff_t n);

/// Standard error of the logarithm of a median of cells.
double medianScatter(double cells);

/// Mean of exponential cells, from those below five times that mean, found in two steps from a first guess. As exact as can be,
/// and no line counts for more than five cells of noise.
float truncatedMean(std::span<const float> cells, float guess);

/// The random walk in a series, x(i) = walk + noise, as a Kalman smoother finds it; 0 all over where it may be none.
///
/// Differences at a lag of k have variance 2r + kq, which gives noise r and walk q. The smoother's steady state is an exponential
/// average forward, with gain α, α²/(1-α) = q/r, and then backward. What lies beyond three deviations moves it no further. There is a
/// walk where the differences at a lag of 16 exceed those at 1 by two standard errors (from medians: steps and clicks are none).
std::vector<float> slowPart(const std::vector<float> &series);

/// The running median of a series over seven values, faded in from `certainty` to one more of its standard errors. `scatter`: of one value.
std::vector<float> suddenPart(const std::vector<float> &series, double scatter, double certainty);

} // namespace faintline
