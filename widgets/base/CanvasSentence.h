#pragma once

#include <qwt_plot_item.h>

#include <QColor>
#include <QString>

namespace faintline {

/// A sentence in the middle of a plot that has nothing to show yet; what to do, never just emptiness.
class CanvasSentence : public QwtPlotItem
{
public:
    CanvasSentence();

    QString text;
    QColor colour;
    int pixelSize = 13;

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
              const QRectF &canvasRect) const override;
};

} // namespace faintline
