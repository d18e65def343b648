#include "widgets/plot/chartSpans.h"

#include "widgets/plot/ChartItems.h"

#include <algorithm>

namespace faintline {

namespace {

    Span spanOf(const std::vector<double> &values)
    {
        if (values.empty())
            return {0.0, 1.0};
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        return {*low, *high};
    }

    /// Adds a margin on both sides; a single value is centred.
    Span aired(Span span, double share)
    {
        const double air = span.high > span.low ? share * (span.high - span.low) : 0.5;
        return {span.low - air, span.high + air};
    }

} // namespace

ChartSpans chartSpans(const Chart &chart, const ChartItems &items, const std::function<bool(std::size_t)> &isShown,
                      const std::optional<Span> &leastOrdinates)
{
    std::vector<double> xs;
    std::vector<double> ys;
    bool areShares = true; // probabilities use all of 0 … 1
    for (std::size_t i = 0; i < chart.curves.size(); ++i) {
        for (const Curve::Point &point : chart.curves[i].points) {
            areShares = areShares && point.y >= 0.0 && point.y <= 1.0;
            xs.push_back(items.abscissa(point.x));
            if (!isShown(i) || (chart.isLogarithmicY && point.y <= 0.0))
                continue;
            ys.push_back(items.ordinate(point.y));
            if (point.interval.low < point.interval.high && !(chart.isLogarithmicY && point.interval.low <= 0.0)) {
                ys.push_back(items.ordinate(point.interval.low));
                ys.push_back(items.ordinate(point.interval.high));
            }
        }
    }
    if (leastOrdinates)
        ys.insert(ys.end(), {items.ordinate(leastOrdinates->low), items.ordinate(leastOrdinates->high)});
    const Span x = aired(spanOf(xs), 0.03);
    const Span y = areShares && !chart.isLogarithmicY ? Span{-0.02, 1.02} : aired(spanOf(ys), 0.05);
    return {x, y};
}

} // namespace faintline
