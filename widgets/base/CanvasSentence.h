#pragma once

#include <qwt_plot_item.h>

#include <QColor>
#include <QString>

namespace faintline {

/// A sentence in the middle of an empty plot that tells the user what to do.
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
