#pragma once

#include <string>

class QwtPlot;

namespace faintline {

/// The points of a plot's visible curves as CSV, "curve,x,y", one row per point; curves without a title are numbered.
/// Bars of a histogram follow, at their middles, with their counts.
/// `isLogarithmicY`: the ordinates are base-10 logarithms and are written as numbers.
std::string plotCsv(const QwtPlot &plot, bool isLogarithmicY);

} // namespace faintline
