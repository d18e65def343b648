#pragma once

#include <qwt_plot_item.h>

#include <QColor>
#include <QString>

#include <vector>

namespace faintline {

/// A place on the x axis that has a name.
struct ChartMark {
    double x = 0.0;
    QString name;
    bool operator==(const ChartMark &) const = default;
};

/// Thin lines over all of a canvas's height, named at the top where the name before leaves room.
class ChartMarks : public QwtPlotItem
{
public:
    ChartMarks();

    std::vector<ChartMark> marks; ///< in ascending order
    QColor colour;
    QColor plate; ///< behind the names

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
              const QRectF &canvasRect) const override;
};

} // namespace faintline
