#pragma once

#include "evaluate/experiments/Chart.h"
#include "widgets/base/Span.h"

#include <cstddef>
#include <functional>
#include <optional>

namespace faintline {

class ChartItems;

/// Spans of a chart's axes in axis coordinates, with a margin at both ends.
struct ChartSpans {
    Span x;
    Span y;
};

/// Spans that contain the points and intervals of a chart. Hidden curves count for x, so that the axis stays when they
/// are shown again, but not for y. If all values lie in 0 … 1, as probabilities do, a linear y axis shows all of 0 … 1.
/// `leastOrdinates`: values that the y axis includes in any case.
ChartSpans chartSpans(const Chart &chart, const ChartItems &items, const std::function<bool(std::size_t)> &isShown,
                      const std::optional<Span> &leastOrdinates);

} // namespace faintline
