#pragma once

#include "base/Axis.h"
#include "base/Random.h"

#include <vector>

namespace faintline {

/// A stationary Gaussian path of unit variance and autocorrelation e^(-|i - j|·step), step in correlation times:
///
///   x₀ = n₀,   x_{k+1} = a·x_k + √(1 - a²)·n_{k+1},   a = e^(-step)
std::vector<double> ornsteinUhlenbeck(Random &random, Index count, double step);

/// Shifts and scales a path to exactly mean 0 and the given standard deviation (of the path itself, 1/n).
void standardise(std::vector<double> &path, double deviation);

/// Linear interpolation in a path; outside it, its end values. Precondition: not empty.
double interpolate(const std::vector<double> &path, double position);

/// Names of a recording's random streams: (kind, number of the block or line).
enum class SimulationStream : std::uint64_t {
    Noise = 1,
    Level,
    Phase,
    Wander,
    FadingReal,
    FadingImaginary,
    Fluctuation
};

inline std::uint64_t streamNumber(SimulationStream kind, Index number)
{
    return std::uint64_t(kind) << 56 | (std::uint64_t(number) & 0x00ffffffffffffffu);
}

} // namespace faintline
