#pragma once

#include <cstdint>

namespace faintline {

/// A 95 % confidence interval.
struct Interval {
    double low = 0.0;
    double high = 0.0;

    bool contains(double value) const { return low <= value && value <= high; }
    bool operator==(const Interval &) const = default;
};

/// Wilson interval of a probability from `successes` in `trials` independent trials (Wilson 1927): never empty, within
/// 0 … 1.
Interval wilsonInterval(std::int64_t successes, std::int64_t trials);

/// Exact interval of a Poisson mean from one count (Garwood 1936, by χ² quantiles).
Interval poissonInterval(std::int64_t count);

/// Interval of a mean: ± 1.96 standard errors.
Interval normalInterval(double mean, double standardError);

} // namespace faintline
