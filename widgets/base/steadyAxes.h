#pragma once

class QString;
class QwtPlot;

namespace faintline {

/// Gives the axes room for labels as wide as these, so that the canvas keeps its place while one scrolls and zooms:
/// `left` for the axes at the sides, `bottom` for half a label that stands out beyond the canvas.
void steadyAxes(QwtPlot &plot, const QString &left, const QString &bottom);

} // namespace faintline
