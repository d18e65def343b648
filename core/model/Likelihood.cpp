#include "model/Likelihood.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/fastmath.h"
#include "base/multiversion.h"

#include <boost/math/special_functions/bessel.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace faintline {

namespace {

    double lnBesselI0(double x)
    {
        if (x < 500.0)
            return std::log(boost::math::cyl_bessel_i(0, x));
        const double inverse = 1.0 / x;
        return x - 0.5 * std::log(2.0 * std::numbers::pi * x) + std::log1p(inverse * (0.125 + inverse * 0.0703125));
    }

    FAINTLINE_MULTIVERSION
    void affine(const float *y, std::size_t n, float slope, float offset, float *out)
    {
        constexpr float largest = std::numeric_limits<float>::max();
        for (std::size_t i = 0; i < n; ++i) {
            float value = y[i] > 0.0f ? y[i] : 0.0f;
            value = value <= largest ? value : 0.0f;
            out[i] = slope * value + offset;
        }
    }

    /// λ = z + ln(1 + z) + offset with z = slope·y.
    FAINTLINE_MULTIVERSION
    void affineWithLogarithm(const float *y, std::size_t n, float slope, float offset, float *out)
    {
        constexpr float largest = std::numeric_limits<float>::max();
        for (std::size_t i = 0; i < n; ++i) {
            float value = y[i] > 0.0f ? y[i] : 0.0f;
            value = value <= largest ? value : 0.0f;
            const float z = slope * value;
            out[i] = z + (fastLn(1.0f + z) + offset);
        }
    }

    // With z = r0·y and w = √(z + c), where -c is the singularity of ln I0(2√z) nearest to 0,
    //
    //   ln I0(2√z) = 2w - ½ ln w + g(1/w),
    //
    // where g is smooth on all of 0 < 1/w ≤ 1/√c: a polynomial of degree 12 is accurate to 1.4e-7 there.
    constexpr double singularity = 1.4457964907366961; ///< (first zero of J0 / 2)²
    constexpr int degree = 12;
    using Polynomial = std::array<float, degree + 1>; ///< in powers of t = 2√c/w - 1

    /// g's polynomial, by interpolation at Chebyshev nodes.
    Polynomial fitPolynomial()
    {
        constexpr int n = degree + 1;
        std::array<double, n> chebyshev{};
        for (int node = 0; node < n; ++node) {
            const double angle = std::numbers::pi * (node + 0.5) / n;
            const double w = 2.0 * std::sqrt(singularity) / (1.0 + std::cos(angle));
            const double z = std::max(0.0, w * w - singularity);
            const double g = lnBesselI0(2.0 * std::sqrt(z)) - 2.0 * w + 0.5 * std::log(w);
            for (int k = 0; k < n; ++k)
                chebyshev[std::size_t(k)] += (k == 0 ? 1.0 : 2.0) / n * g * std::cos(k * angle);
        }
        // Converts the Chebyshev series to powers of t, by T_k+1 = 2t·T_k - T_k-1.
        std::array<double, n> sum{};
        std::array<double, n> before{};
        std::array<double, n> now{};
        now[0] = 1.0;
        for (std::size_t k = 0; k < n; ++k) {
            for (std::size_t i = 0; i < n; ++i)
                sum[i] += chebyshev[k] * now[i];
            std::array<double, n> next{};
            for (std::size_t i = 0; i < n; ++i)
                next[i] = (i > 0 ? (k == 0 ? 1.0 : 2.0) * now[i - 1] : 0.0) - (k == 0 ? 0.0 : before[i]);
            before = now;
            now = next;
        }
        Polynomial result{};
        std::transform(sum.begin(), sum.end(), result.begin(), [](double value) { return float(value); });
        return result;
    }

    const Polynomial &smoothPart()
    {
        static const Polynomial fitted = fitPolynomial();
        return fitted;
    }

    /// -r0 + 2w would suffer from cancellation; instead, with 4w² - r0² = 4·r0·(y - r0/4) + 4c, λ = (4w² - r0²)/(2w +
    /// r0) - ½ ln w + g, with the difference computed from y in two parts.
    FAINTLINE_MULTIVERSION
    void rice(const float *y, std::size_t n, const Polynomial &g, double snr, float *out)
    {
        constexpr float largest = 1e30f;
        constexpr float c = float(singularity);
        const auto scale = float(2.0 * std::sqrt(singularity));
        const auto r0 = float(snr);
        const auto quarter = float(0.25 * snr);
        const auto rest = float(0.25 * snr - double(quarter));
        for (std::size_t i = 0; i < n; ++i) {
            float value = y[i] > 0.0f ? y[i] : 0.0f;
            value = value <= largest ? value : 0.0f;
            const float square = r0 * value + c;
            const float w = std::sqrt(square);
            const float t = scale / w - 1.0f;
            float sum = g[degree];
            for (int k = degree - 1; k >= 0; --k)
                sum = sum * t + g[std::size_t(k)];
            const float difference = 4.0f * (r0 * ((value - quarter) - rest) + c);
            out[i] = difference / (2.0f * w + r0) + (sum - 0.25f * fastLn(square));
        }
    }

    /// Sets λ = 0 where y is NaN, in a separate pass, because the comparison prevents vectorisation of the formulas.
    FAINTLINE_MULTIVERSION
    void leaveOutUnobserved(const float *y, std::size_t n, float *lambda)
    {
        for (std::size_t i = 0; i < n; ++i)
            lambda[i] = y[i] == y[i] ? lambda[i] : 0.0f;
    }

} // namespace

Likelihood::Likelihood(LikelihoodKind kind, double snr) : m_kind(kind), m_snr(snr)
{
    const bool needsSnr = kind != LikelihoodKind::Linear && kind != LikelihoodKind::Given;
    if (needsSnr && !(snr > 0.0 && snr < 1e12))
        throw Error(std::string("likelihood ") + std::string(likelihoodNames[std::size_t(kind)]) + ", SNR "
                        + formatNumber(snr),
                    "must be a power ratio above 0");
}

double Likelihood::at(double y) const
{
    if (std::isnan(y))
        return 0.0;
    if (m_kind == LikelihoodKind::Given)
        return y;
    if (!(y > 0.0) || !std::isfinite(y))
        y = 0.0;
    switch (m_kind) {
    case LikelihoodKind::Rice:
        return -m_snr + lnBesselI0(2.0 * std::sqrt(m_snr * y));
    case LikelihoodKind::Exponential:
        return y * m_snr / (1.0 + m_snr) - std::log1p(m_snr);
    case LikelihoodKind::Swerling4: {
        const double half = 0.5 * m_snr;
        const double z = y * half / (1.0 + half);
        return z + std::log1p(z) - 2.0 * std::log1p(half);
    }
    case LikelihoodKind::Linear:
    case LikelihoodKind::Given:
        return y;
    }
    return 0.0;
}

void Likelihood::apply(std::span<const float> y, std::span<float> out) const
{
    switch (m_kind) {
    case LikelihoodKind::Rice:
        rice(y.data(), y.size(), smoothPart(), m_snr, out.data());
        break;
    case LikelihoodKind::Exponential:
        affine(y.data(), y.size(), float(m_snr / (1.0 + m_snr)), float(-std::log1p(m_snr)), out.data());
        break;
    case LikelihoodKind::Swerling4: {
        const double half = 0.5 * m_snr;
        affineWithLogarithm(y.data(), y.size(), float(half / (1.0 + half)), float(-2.0 * std::log1p(half)), out.data());
        break;
    }
    case LikelihoodKind::Linear:
        affine(y.data(), y.size(), 1.0f, 0.0f, out.data());
        break;
    case LikelihoodKind::Given:
        std::copy(y.begin(), y.end(), out.begin());
        break;
    }
    leaveOutUnobserved(y.data(), y.size(), out.data());
}

} // namespace faintline
