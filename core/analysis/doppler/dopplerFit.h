#pragma once

#include "analysis/doppler/DopplerPass.h"

#include <vector>

namespace faintline {

/// Least points of a fit: twice as many as parameters.
constexpr std::size_t leastDopplerPoints = 8;

/// The pass that a track's frequencies tell of: f0, v, R and t0 with their 90 % intervals, residuals, and what cannot
/// be told.
///
/// Weighted least squares: Σ ((f_i - f(t_i))/σ_i)² is made least by Levenberg and Marquardt from the best of a grid
/// (dopplerStarts.h).
///
///   outliers     Points further off than four robust standard deviations (1.4826 times the median of |residual|/σ) are
///                left out, until the same ones stay out. A few frames that followed something else move nothing.
///   correlation  Errors of neighbouring frames are alike, for windows overlap and paths are smoothed. They are taken
///                as an autoregressive process, which is estimated from the residuals (CorrelatedErrors.h), and
///                whitened.
///   scale        One factor of all σ_i is estimated from the whitened residuals, so only their ratios matter.
///   intervals    By profile likelihood (dopplerLimits.h): speed and range go together along a bent ridge, of which no
///                linearisation knows. The critical value is the 95 % quantile of Student's law with n_eff - 4 degrees
///                of freedom, n_eff = 1ᵀP⁻¹1 of the correlations P.
///                Where a straight line fits within 25 of the pass's χ², small passes fit the errors, and the usual law
///                does not hold: the limits are then those of the region of all four parameters at 99 %.
///
/// Only v/c, R/c, f0 and t0 are measured: v and R are in proportion to `propagation`. Sentences say which intervals are
/// open and why, where the residuals speak against a straight pass, and what one sensor never tells.
/// Throws Error where there are fewer than 8 points, times do not increase, a number is not finite, or a frequency or a
/// deviation is not above 0. Source of the method: Ferguson and Quinn 1994, J. Acoust. Soc. Am. 96, 821. Oracle: 1000
/// simulated passes.
DopplerFit fitDopplerPass(const std::vector<DopplerPoint> &points, double propagation);

} // namespace faintline
