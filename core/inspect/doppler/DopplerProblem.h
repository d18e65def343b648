#pragma once

#include "inspect/doppler/DopplerPass.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace faintline {

/// Correlated errors of a sequence: an autoregressive process of a low order p, stationary within stretches and
/// independent between stretches.
///
/// It is parametrised by its partial correlations κ_1 … κ_p, each within -1 … 1, as any stationary process can be. The
/// Levinson-Durbin recursion turns them into the best predictors of an error from the k before it, k ≤ p, and the
/// variance that remains, v_k = Π_{i≤k} (1 - κ_i²). Whitening subtracts the prediction from each value and divides by
/// √v_k: W with WᵀW = P⁻¹, P the correlation matrix, exact from the first value of each stretch.
class CorrelatedErrors
{
public:
    /// `isFirst`: one per value, 1 where a stretch begins.
    CorrelatedErrors(std::vector<char> isFirst, const std::vector<double> &partial);

    std::size_t order() const { return m_predictors.size() - 1; }
    /// W·values, in place; one value per point.
    void whiten(Eigen::Ref<Eigen::VectorXd> values) const;
    /// Number of uncorrelated points equally informative about a constant: 1ᵀP⁻¹1.
    double effectiveCount() const;
    /// ln |P|.
    double logDeterminant() const;

private:
    std::vector<std::size_t> m_known;              ///< preceding values in the stretch, at most p
    std::vector<std::vector<double>> m_predictors; ///< from k = 0 … p preceding values; nearest first
    std::vector<double> m_variances;
};

/// Maximum-likelihood errors for the residuals r of a fit with derivatives J (one column per parameter).
///
/// The partial correlations maximise the restricted likelihood, which ignores what the parameters removed from the
/// residuals:  -2 ln L = (n - p_J) ln RSS + ln|P| + ln|JᵀP⁻¹J|,  with the scale maximised out. The order, at most 5,
/// minimises the Akaike criterion, -2 ln L + 2·order. Source: Patterson and Thompson 1971; Akaike 1974.
CorrelatedErrors likeliestErrors(const Eigen::VectorXd &r, const Eigen::MatrixXd &J, const std::vector<char> &isFirst);

/// The four parameters of a pass, in the order of their coordinates.
enum class DopplerParameter { RestHz, Speed, Range, Closest };

/// Coordinates in which a fit is well conditioned: all near 1, unbounded, and weakly correlated where the pass is
/// observed. F and S are the centre and span of the track's frequencies, M and L those of its times.
///
///   x0 = (f0 - F)/S,  x1 = ln(β/(1 - β)) with β = v/c,  x2 = ln(T/L) with T = R/v,  x3 = (t0 + R/c - M)/L
using DopplerCoordinates = Eigen::Vector4d;

/// Weighted residuals of a track's points for a pass, whitened if their errors are correlated.
///
/// Profiles hold one parameter and minimise over the others. The parameter's own coordinate z replaces the coordinate
/// of the same index: z0 = x0, z1 = x1, z2 = ln(R/(c·L)), z3 = (t0 - M)/L.
class DopplerProblem
{
public:
    DopplerProblem(const std::vector<DopplerPoint> &points, double propagation);

    std::size_t count() const { return m_points.size(); } ///< number of points in the fit

    DopplerPass passOf(const DopplerCoordinates &x) const;
    DopplerCoordinates coordinatesOf(const DopplerPass &pass) const;
    double ownCoordinate(DopplerParameter parameter, const DopplerCoordinates &x) const;
    /// Value of the parameter, in its unit.
    double valueOf(DopplerParameter parameter, double ownCoordinate) const;
    /// Coordinate of a value, f0 ≥ 0.
    double coordinateOfRest(double hz) const { return (hz - m_middleHz) / m_spanHz; }

    /// The same problem with other points in the same coordinates and uncorrelated errors.
    DopplerProblem with(std::vector<DopplerPoint> points) const;

    /// Estimates the correlation of the errors from the residuals of a pass. Gaps of four steps end a stretch. Errors
    /// that appear to cancel, with n_eff above 1.5 n, are treated as independent: few residuals look so by chance.
    void estimateCorrelation(const DopplerCoordinates &x);
    const CorrelatedErrors &errors() const { return m_errors; }

    /// Whitened (measured - fitted)/deviation and, if requested, its derivatives with respect to x.
    Eigen::VectorXd residuals(const DopplerCoordinates &x, Eigen::MatrixXd *derivatives = nullptr) const;
    double cost(const DopplerCoordinates &x) const { return residuals(x).squaredNorm(); }

    /// Minimum cost of a straight line f = a + b·t instead of a pass.
    double straightLineCost() const;

    /// The nearest local minimum of the cost, by Levenberg-Marquardt (Eigen): over all coordinates, or over those of
    /// three parameters while one is held at its own coordinate.
    DopplerCoordinates minimum(const DopplerCoordinates &from) const;
    DopplerCoordinates minimum(const DopplerCoordinates &from, DopplerParameter held, double ownCoordinate) const;

private:
    std::vector<DopplerPoint> m_points;
    double m_propagation;
    double m_middleHz = 0.0;
    double m_spanHz = 1.0;
    double m_middleSeconds = 0.0;
    double m_spanSeconds = 1.0;
    CorrelatedErrors m_errors;
};

/// The best fit of a problem and the scale of its intervals.
struct DopplerOptimum {
    DopplerCoordinates x;
    double cost = 0.0;     ///< sum of squares of the whitened residuals
    double variance = 1.0; ///< estimated variance of one of them
    double critical = 0.0; ///< half-width of an interval in standard deviations: a Student quantile
};

/// The limits of the four parameters by profile likelihood, in the order of DopplerParameter.
///
/// A value ψ of a parameter lies inside if √((min cost over the other three at ψ - cost)/variance) ≤ critical. The
/// profile is followed outwards from the optimum in growing steps until this is exceeded; TOMS 748 locates the
/// crossing. If another profile passes the limit, this one is followed further from there. An end is open if it is not
/// exceeded within the limits of the parameter: f0 = 0, v = 0 and v = c, R a million times smaller or larger, t0 200
/// track lengths away.
///
/// If a profile finds a lower cost than the optimum's, `optimum` moves there, and the limits are those of the new one.
///
/// `others`: other minima, included if they lie inside.
std::array<DopplerBounds, 4> dopplerLimits(const DopplerProblem &problem, DopplerOptimum &optimum,
                                           const std::vector<DopplerCoordinates> &others);

} // namespace faintline
