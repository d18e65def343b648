#include "model/Likelihood.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/multiversion.h"

#include <boost/math/special_functions/bessel.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace faintline {

namespace {

    // Cubic pieces over 0 ≤ x < 160, x = 2√(r0·y).
    constexpr float piecesPerUnit = 16.0f;
    constexpr float tableEnd = 160.0f;
    constexpr int pieceCount = 160 * 16;

    double lnBesselI0(double x)
    {
        if (x < 500.0)
            return std::log(boost::math::cyl_bessel_i(0, x));
        const double inverse = 1.0 / x;
        return x - 0.5 * std::log(2.0 * std::numbers::pi * x) + std::log1p(inverse * (0.125 + inverse * 0.0703125));
    }

    /// d/dx ln I0(x) = I1(x)/I0(x)
    double slopeOfLnBesselI0(double x)
    {
        if (x < 500.0)
            return boost::math::cyl_bessel_i(1, x) / boost::math::cyl_bessel_i(0, x);
        return 1.0 - 0.5 / x - 0.125 / (x * x);
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

    /// -r0 + ln I0(x) by Hermite's cubic through both ends' values and slopes, four coefficients a piece. r0 is subtracted
    /// here, in double precision, because the two terms cancel.
    std::vector<float> makeRiceTable(double snr)
    {
        std::vector<float> table(4 * static_cast<std::size_t>(pieceCount));
        const double width = 1.0 / static_cast<double>(piecesPerUnit);
        for (int piece = 0; piece < pieceCount; ++piece) {
            const double left = piece * width;
            const double v0 = lnBesselI0(left) - snr;
            const double v1 = lnBesselI0(left + width) - snr;
            const double d0 = slopeOfLnBesselI0(left) * width;
            const double d1 = slopeOfLnBesselI0(left + width) * width;
            float *c = table.data() + 4 * piece;
            c[0] = static_cast<float>(v0);
            c[1] = static_cast<float>(d0);
            c[2] = static_cast<float>(3.0 * (v1 - v0) - 2.0 * d0 - d1);
            c[3] = static_cast<float>(2.0 * (v0 - v1) + d0 + d1);
        }
        return table;
    }

    /// The table at x = 2√(r0·y), held at its end beyond it.
    FAINTLINE_MULTIVERSION
    void rice(const float *y, std::size_t n, const float *table, float snr, float *out)
    {
        constexpr float last = static_cast<float>(pieceCount) - 0.001f;
        const float scale = 4.0f * snr * piecesPerUnit * piecesPerUnit;
        for (std::size_t i = 0; i < n; ++i) {
            const float value = y[i] > 0.0f ? y[i] : 0.0f;
            float position = std::sqrt(scale * value);
            position = position < last ? position : last;
            const int piece = static_cast<int>(position);
            const float x = position - static_cast<float>(piece);
            const float *c = table + 4 * piece;
            out[i] = c[0] + x * (c[1] + x * (c[2] + x * c[3]));
        }
    }

} // namespace

Likelihood::Likelihood(LikelihoodKind kind, double snr) : m_kind(kind), m_snr(snr)
{
    if (kind != LikelihoodKind::Linear && !(snr > 0.0 && snr < 1e12))
        throw Error(std::string("likelihood ") + std::string(likelihoodNames[static_cast<std::size_t>(kind)]) + ", SNR "
                        + formatNumber(snr),
                    "must be a power ratio above 0");
    if (kind == LikelihoodKind::Rice)
        m_riceTable = std::make_shared<const std::vector<float>>(makeRiceTable(snr));
}

double Likelihood::at(double y) const
{
    if (!(y > 0.0) || !std::isfinite(y))
        y = 0.0;
    switch (m_kind) {
    case LikelihoodKind::Rice:
        return -m_snr + lnBesselI0(2.0 * std::sqrt(m_snr * y));
    case LikelihoodKind::Exponential:
        return y * m_snr / (1.0 + m_snr) - std::log1p(m_snr);
    case LikelihoodKind::Linear:
        return y;
    }
    return 0.0;
}

void Likelihood::apply(std::span<const float> y, std::span<float> out) const
{
    switch (m_kind) {
    case LikelihoodKind::Rice:
        applyRice(y, out);
        break;
    case LikelihoodKind::Exponential:
        affine(y.data(), y.size(), static_cast<float>(m_snr / (1.0 + m_snr)), static_cast<float>(-std::log1p(m_snr)), out.data());
        break;
    case LikelihoodKind::Linear:
        affine(y.data(), y.size(), 1.0f, 0.0f, out.data());
        break;
    }
}

void Likelihood::applyRice(std::span<const float> y, std::span<float> out) const
{
    rice(y.data(), y.size(), m_riceTable->data(), static_cast<float>(m_snr), out.data());
    const auto largestY = static_cast<float>(static_cast<double>(tableEnd) * static_cast<double>(tableEnd) / (4.0 * m_snr));
    for (std::size_t i = 0; i < y.size(); ++i)
        if (!(y[i] < largestY))
            out[i] = static_cast<float>(at(static_cast<double>(y[i])));
}

} // namespace faintline
