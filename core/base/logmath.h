#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

constexpr double minusInfinity = -std::numeric_limits<double>::infinity();

/// ln(eᵃ + eᵇ) without overflow; -∞ is the neutral element.
inline double logSumExp(double a, double b)
{
    const double high = std::max(a, b);
    if (high == minusInfinity)
        return high;
    return high + std::log1p(std::exp(std::min(a, b) - high));
}

/// Power ratio ↔ decibel, the only place in the program where they meet.
inline double dbFromRatio(double powerRatio)
{
    return 10.0 * std::log10(powerRatio);
}

inline double ratioFromDb(double db)
{
    return std::pow(10.0, db / 10.0);
}

} // namespace faintline
