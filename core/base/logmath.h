#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

constexpr double minusInfinity = -std::numeric_limits<double>::infinity();
/// ln 0: the score of a state that no path reaches.
constexpr float unreached = -std::numeric_limits<float>::infinity();

/// Conversion between power ratio and decibels; used throughout the program.
inline double dbFromRatio(double powerRatio)
{
    return 10.0 * std::log10(powerRatio);
}

inline double ratioFromDb(double db)
{
    return std::pow(10.0, db / 10.0);
}

} // namespace faintline
