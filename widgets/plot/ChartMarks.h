#pragma once

#include <qwt_plot_item.h>

#include <QColor>
#include <QString>

#include <vector>

namespace faintline {

/// A named position on the x axis.
struct ChartMark {
    double x = 0.0;
    QString name;
    bool operator==(const ChartMark &) const = default;
};

/// Thin lines over the canvas's full height, named at the top if the previous name leaves room.
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
