#pragma once

#include "inspect/doppler/DopplerPass.h"
#include "plan/AnalysisPlan.h"

#include <vector>

namespace faintline {

/// Minimum number of points of a fit: twice the number of parameters.
constexpr std::size_t leastDopplerPoints = 8;

/// Fits a pass to a track's frequencies: f0, v, R and t0 with their 90 % intervals, residuals, and limitations.
///
/// Weighted least squares: Σ ((f_i - f(t_i))/σ_i)² is minimised by Levenberg-Marquardt from the best of a grid
/// (dopplerFit.h).
///
///   outliers     Points more than four robust standard deviations off (1.4826 times the median of |residual|/σ) are
///                excluded, until the set is stable. A few frames that followed another signal have no effect.
///   correlation  Errors of neighbouring frames are correlated, because windows overlap and paths are smoothed. They
///                are modelled as an autoregressive process, estimated from the residuals (DopplerProblem.h), and
///                whitened.
///   scale        A common factor of all σ_i is estimated from the whitened residuals; only their ratios matter.
///   intervals    By profile likelihood (dopplerLimits): speed and range vary together along a curved ridge, which a
///                linearisation misses. The critical value is the 95 % quantile of Student's t distribution with
///                n_eff - 4 degrees of freedom, n_eff = 1ᵀP⁻¹1 for the correlation matrix P.
///                If a straight line fits within 25 of the pass's χ², small passes fit the errors and the usual law
///                does not hold: the limits are then those of the joint region of all four parameters at 99 %.
///
/// Only v/c, R/c, f0 and t0 are measured: v and R are proportional to `propagation`. Sentences state which intervals
/// are open and why, whether the residuals contradict a straight pass, and what one sensor cannot determine.
/// Throws Error if there are fewer than 8 points, times do not increase, a number is not finite, or a frequency or a
/// deviation is not above 0. Source of the method: Ferguson and Quinn 1994, J. Acoust. Soc. Am. 96, 821. Oracle: 1000
/// simulated passes.
DopplerFit fitDopplerPass(const std::vector<DopplerPoint> &points, double propagation);

/// A track's frequencies for `fitDopplerPass`.
struct DopplerTrack {
    std::vector<DopplerPoint> points; ///< by time
    Index steepCount = 0;             ///< points excluded because the model cannot follow faster
    double steepestHzPerSecond = 0.0; ///< steepest fall that the model can follow
};

/// A track's absolute frequencies: those of its frames plus `centreHz`.
///
/// For a smoothed track: the smoothed path where the signal is present (probability ½ or more), with
/// SmoothedPoint::deviation. Otherwise: the cells of the path, whose rounding has a standard deviation of 1/√12 cell.
/// Where the path is as steep as the model allows (85 %), and two frames on either side, the line may drift faster than
/// the path can follow: these points are excluded, as are adjoining pieces shorter than 16 frames. A path that lags
/// behind a pass mimics a slower and nearer one. Throws Error if the frames have axes other than frequency.
DopplerTrack dopplerTrack(const AnalysisPlan &plan, const Track &track, double centreHz);

/// Several tracks of one pass, such as before and after a closest approach that was too fast to follow. Throws Error if
/// they overlap in time.
DopplerTrack joined(const std::vector<DopplerTrack> &tracks);

} // namespace faintline
