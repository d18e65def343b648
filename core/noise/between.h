#pragma once

#include "base/Axis.h"

#include <algorithm>

namespace faintline {

/// Weights of linear interpolation on an axis: index of the lower neighbour and the fraction toward the next.
struct Between {
    Index lower;
    double fraction;
};

inline Between between(const Axis &axis, double value)
{
    const double position = std::clamp(axis.position(value), 0.0, double(axis.count - 1));
    const Index lower = std::min(Index(position), std::max<Index>(0, axis.count - 2));
    return {lower, axis.count < 2 ? 0.0 : position - double(lower)};
}

} // namespace faintline
