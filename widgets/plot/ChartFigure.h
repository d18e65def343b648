#pragma once

#include <QPicture>
#include <QWidget>

namespace faintline {

class ChartPlot;

/// A chart for printing: light colours, no controls, and a caption below. It is a separate widget that is never shown
/// on the screen.
class ChartFigure : public QWidget
{
    Q_OBJECT

public:
    /// Redraws the curves that `chart` shows.
    ChartFigure(const ChartPlot &chart, const QString &caption);
    /// Records any other plot in light colours.
    ChartFigure(QWidget &plot, const QString &caption);

private:
    void layOut(QWidget *figure, const QString &caption);
};

} // namespace faintline
