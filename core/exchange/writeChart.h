#pragma once

#include "evaluate/experiments/Chart.h"

#include <span>
#include <string>

namespace faintline {

/// A chart as SVG text, 720 × 480 pixels: measured curves with their intervals, theory as dashed lines, published
/// points hollow. The same chart gives the same bytes.
std::string chartSvg(const Chart &chart);

/// The first chart as above, the others below it, 280 pixels high, for charts with the same x axis.
std::string chartsSvg(std::span<const Chart> charts);

/// A chart's points as CSV: "curve,kind,x,y,low,high", one row per point; low and high are empty without an interval.
std::string chartCsv(const Chart &chart);

} // namespace faintline
