#pragma once

#include <qwt_plot_item.h>

#include <QColor>
#include <QString>

namespace faintline {

/// Words on a plate beside a vertical line, always wholly on the canvas.
class LineLabel : public QwtPlotItem
{
public:
    LineLabel();

    double x = 0.0;
    QString text;
    QColor colour;
    QColor plate;

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
              const QRectF &canvasRect) const override;
};

} // namespace faintline
