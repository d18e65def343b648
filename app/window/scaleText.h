#pragma once

class QWidget;

namespace faintline {

/// Text size of a panel relative to the usual one, for presentations. Plots are left alone: they follow
/// Theme::setPlotScale.
void scaleText(QWidget &panel, double scale);

} // namespace faintline
