#include "refine/PolynomialFit.h"

#include "refine/constants.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

PolynomialFit::PolynomialFit(std::span<const SmoothedPoint> points, Index first, double leastDeviation)
    : m_middle(double(first) + 0.5 * double(points.size() - 1))
{
    const auto n = double(points.size());
    m_meanSquare = (n * n - 1.0) / 12.0;
    double squares[3] = {n, 0.0, 0.0};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double t = double(first) + double(i) - m_middle;
        const double p = t * t - m_meanSquare;
        m_coefficients[0] += points[i].position;
        m_coefficients[1] += points[i].position * t;
        m_coefficients[2] += points[i].position * p;
        squares[1] += t * t;
        squares[2] += p * p;
    }
    for (std::size_t k = 0; k < 3; ++k)
        m_coefficients[k] = squares[k] > 0.0 ? m_coefficients[k] / squares[k] : 0.0;
    const auto setVariances = [&](std::size_t parameters) {
        double sum = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double error = points[i].position - positionAt(double(first) + double(i));
            sum += error * error;
        }
        const double residual = std::max(leastDeviation * leastDeviation, sum / std::max(1.0, n - double(parameters)));
        for (std::size_t k = 0; k < 3; ++k)
            m_variances[k] =
                squares[k] > 0.0 ? correlatedFrames * residual / squares[k] : std::numeric_limits<double>::infinity();
    };
    if (points.size() >= fewestCurvatureFrames) {
        m_isCurved = true;
        setVariances(3);
        m_isCurved = std::abs(m_coefficients[2]) > curvatureDeviations * std::sqrt(m_variances[2]);
    }
    if (!m_isCurved)
        setVariances(2);
    if (points.size() < 3)
        m_variances[1] = std::numeric_limits<double>::infinity();
}

double PolynomialFit::positionAt(double frame) const
{
    const double t = frame - m_middle;
    return m_coefficients[0] + m_coefficients[1] * t + (m_isCurved ? m_coefficients[2] * (t * t - m_meanSquare) : 0.0);
}

double PolynomialFit::positionVarianceAt(double frame) const
{
    const double t = frame - m_middle;
    const double p = t * t - m_meanSquare;
    return m_variances[0] + (t == 0.0 ? 0.0 : t * t * m_variances[1]) + (m_isCurved ? p * p * m_variances[2] : 0.0);
}

double PolynomialFit::slopeAt(double frame) const
{
    return m_coefficients[1] + (m_isCurved ? 2.0 * (frame - m_middle) * m_coefficients[2] : 0.0);
}

double PolynomialFit::slopeVarianceAt(double frame) const
{
    const double t = frame - m_middle;
    return m_variances[1] + (m_isCurved ? 4.0 * t * t * m_variances[2] : 0.0);
}

} // namespace faintline
