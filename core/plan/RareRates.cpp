#include "plan/RareRates.h"

#include <algorithm>

namespace faintline {

namespace {

    /// Interpolates values given at levels, and extrapolates linearly beyond them.
    double interpolated(const std::vector<double> &levels, const std::vector<double> &values, double level)
    {
        if (levels.size() == 1)
            return values.front();
        const auto above = std::upper_bound(levels.begin() + 1, levels.end() - 1, level);
        const auto upper = std::size_t(above - levels.begin());
        const double fraction = (level - levels[upper - 1]) / (levels[upper] - levels[upper - 1]);
        return values[upper - 1] + fraction * (values[upper] - values[upper - 1]);
    }

} // namespace

double RareRates::lnRateAt(double level) const
{
    return interpolated(levels, lnRates, level);
}

double RareRates::relativeErrorAt(double level) const
{
    const double known = interpolated(levels, relativeErrors, std::clamp(level, levels.front(), levels.back()));
    const double growth = (relativeErrors.back() - relativeErrors.front()) / (levels.back() - levels.front());
    return known + std::max(0.0, growth) * std::max(0.0, level - levels.back());
}

} // namespace faintline
