#pragma once

#include "track/Track.h"

#include <cstddef>
#include <span>

namespace faintline {

/// Least-squares polynomial through positions that are one frame apart: a straight line, or a parabola if its curvature
/// exceeds three standard errors.
///
///   f(t) = Σ c_k P_k(t),   P_0 = 1,  P_1 = t,  P_2 = t² - mean(t²),   t = frame - middle
///
/// The P_k are orthogonal, so the variance of f(t) is Σ P_k(t)²·var c_k. Variances are 6 times those of independent
/// errors, because neighbouring frames share samples and positions are averaged along the path. The variance of the
/// residuals is at least (`leastDeviation`)². Fewer than three points have no slope: its variance is infinite.
class PolynomialFit
{
public:
    /// `first`: frame of the first point.
    PolynomialFit(std::span<const SmoothedPoint> points, Index first, double leastDeviation);

    bool isCurved() const { return m_isCurved; }

    double positionAt(double frame) const;
    double positionVarianceAt(double frame) const;
    double slopeAt(double frame) const; ///< cells per frame
    double slopeVarianceAt(double frame) const;

private:
    double m_middle;
    double m_meanSquare = 0.0;
    double m_coefficients[3] = {};
    double m_variances[3] = {};
    bool m_isCurved = false;
};

} // namespace faintline
