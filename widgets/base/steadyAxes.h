#pragma once

class QString;
class QwtPlot;

namespace faintline {

/// Reserves room on the axes for labels of these widths, so that the canvas does not move while scrolling and zooming:
/// `left` for the axes at the sides, `bottom` for half a label that extends beyond the canvas.
void steadyAxes(QwtPlot &plot, const QString &left, const QString &bottom);

} // namespace faintline
