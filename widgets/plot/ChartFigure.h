#pragma once

#include <QPicture>
#include <QWidget>

namespace faintline {

class ChartPlot;

/// A chart as it is printed: light, without what is there to be clicked, a caption below. A page of its own that is
/// never seen on the screen; what is on the screen keeps its looks.
class ChartFigure : public QWidget
{
    Q_OBJECT

public:
    /// The curves that `chart` shows, drawn anew.
    ChartFigure(const ChartPlot &chart, const QString &caption);
    /// Any other plot, recorded in light colours.
    ChartFigure(QWidget &plot, const QString &caption);

private:
    void layOut(QWidget *figure, const QString &caption);
};

} // namespace faintline
