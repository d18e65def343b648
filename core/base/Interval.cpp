#include "base/Interval.h"

#include <boost/math/distributions/chi_squared.hpp>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double z = 1.959963984540054; // 97.5 % quantile of the normal law

} // namespace

Interval wilsonInterval(std::int64_t successes, std::int64_t trials)
{
    if (trials <= 0)
        return {0.0, 1.0};
    const auto n = double(trials);
    const double p = double(successes) / n;
    const double centre = p + z * z / (2.0 * n);
    const double half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
    const double scale = 1.0 + z * z / n;
    // At 0 and n the ends are exact; rounding must not push them past the estimate.
    return {successes == 0 ? 0.0 : std::max(0.0, (centre - half) / scale),
            successes == trials ? 1.0 : std::min(1.0, (centre + half) / scale)};
}

Interval poissonInterval(std::int64_t count)
{
    using boost::math::chi_squared;
    using boost::math::quantile;
    const auto n = double(count);
    return {count == 0 ? 0.0 : 0.5 * quantile(chi_squared(2.0 * n), 0.025),
            0.5 * quantile(chi_squared(2.0 * n + 2.0), 0.975)};
}

Interval normalInterval(double mean, double standardError)
{
    return {mean - z * standardError, mean + z * standardError};
}

} // namespace faintline
