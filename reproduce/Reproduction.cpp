#include "reproduce/Reproduction.h"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>

namespace faintline {

Interval ReproducedCell::jointInterval() const
{
    constexpr double single = 1.959963984540054;
    constexpr double byChance = 0.05;
    constexpr double seeds = 20.0;
    const double tail = 0.5 * byChance / (seeds * std::max(1, judgedTogether));
    const double deviations =
        runs > 1 ? boost::math::quantile(boost::math::complement(boost::math::students_t(runs - 1.0), tail))
                 : boost::math::quantile(boost::math::complement(boost::math::normal(), tail));
    const double widening = deviations / single;
    return {ours - widening * (ours - interval.low), ours + widening * (interval.high - ours)};
}

bool ReproducedCell::isInside() const
{
    if (!reference || std::abs(ours - *reference) <= tolerance)
        return true;
    return interval.low < interval.high && jointInterval().contains(*reference);
}

std::optional<double> ReproducedCell::z() const
{
    constexpr double errorsPerInterval = 2.0 * 1.959963984540054;
    const double standardError = std::hypot((interval.high - interval.low) / errorsPerInterval, paperError);
    if (!paper || !(standardError > 0.0))
        return std::nullopt;
    return (ours - *paper) / standardError;
}

bool Reproduction::isInside() const
{
    return std::all_of(cells.begin(), cells.end(), [](const ReproducedCell &cell) { return cell.isInside(); });
}

void judgeTogether(Reproduction &reproduction)
{
    const auto judged = std::count_if(reproduction.cells.begin(), reproduction.cells.end(),
                                      [](const ReproducedCell &cell) { return cell.isJudged(); });
    for (ReproducedCell &cell : reproduction.cells)
        cell.judgedTogether = int(judged);
}

} // namespace faintline
