#pragma once

#include "evaluate/Chart.h"

#include <string>

namespace faintline {

/// A chart as SVG text, 720 × 480 pixels: measured curves with their intervals, theory as dashed lines, publications' points hollow.
/// The same chart gives the same bytes.
std::string chartSvg(const Chart &chart);

} // namespace faintline
