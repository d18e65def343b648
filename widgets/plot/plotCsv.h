#pragma once

#include <string>

class QwtPlot;

namespace faintline {

/// The points of a plot's visible curves as CSV, "curve,x,y", a row per point; curves without a title are numbered.
/// `isLogarithmicY`: the ordinates are logarithms (base 10), and their numbers are written.
std::string plotCsv(const QwtPlot &plot, bool isLogarithmicY);

} // namespace faintline
