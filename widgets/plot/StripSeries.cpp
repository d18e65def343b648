#include "widgets/plot/StripSeries.h"

#include <algorithm>
#include <cmath>

namespace faintline {

QPolygonF StripSeries::points(const Span &span, int pixels)
{
    seen = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    QPolygonF polygon;
    if (values.empty())
        return polygon;
    const auto indexAt = [this](double seconds, double toward) {
        return Index(std::clamp(std::floor(time.position(seconds)) + toward, 0.0, double(values.size() - 1)));
    };
    const Index first = indexAt(span.low, 0.0), last = indexAt(span.high, 1.0);
    const Index stride = std::max<Index>((last - first) / std::max(pixels, 1), 1);
    for (Index i = first - first % stride; i <= last; i += stride) {
        const Index end = std::min(i + stride, Index(values.size()));
        appendExtremes(i, end, polygon);
    }
    return polygon;
}

void StripSeries::appendExtremes(Index begin, Index end, QPolygonF &polygon)
{
    Index low = -1, high = -1;
    for (Index i = begin; i < end; ++i) {
        const float value = values[std::size_t(i)];
        if (!std::isfinite(value))
            continue;
        if (low < 0 || value < values[std::size_t(low)])
            low = i;
        if (high < 0 || value > values[std::size_t(high)])
            high = i;
    }
    if (low < 0)
        return;
    const auto add = [&](Index i) {
        const double value = double(values[std::size_t(i)]);
        polygon << QPointF(time.value(double(i)), value);
        seen = {std::min(seen.low, value), std::max(seen.high, value)};
    };
    add(std::min(low, high));
    if (low != high)
        add(std::max(low, high));
}

} // namespace faintline
