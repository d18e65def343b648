#pragma once

#include <qwt_plot_item.h>

#include <QColor>
#include <QString>

namespace faintline {

/// Text on a background beside a vertical line, always completely on the canvas.
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
