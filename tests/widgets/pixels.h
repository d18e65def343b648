#pragma once

#include "widgets/base/Span.h"

#include <qwt_plot.h>
#include <qwt_scale_div.h>

#include <QImage>
#include <QPolygon>
#include <QSet>
#include <QtTest>

namespace faintline::test {

inline void show(QWidget &view, const QSize &size = {640, 360})
{
    view.resize(size);
    view.show();
    QVERIFY(QTest::qWaitForWindowExposed(&view));
}

/// What an axis of a plot spans.
inline Span spanOf(const QwtPlot &plot, QwtAxisId axis)
{
    return {plot.axisScaleDiv(axis).lowerBound(), plot.axisScaleDiv(axis).upperBound()};
}

/// What is on a plot's canvas.
inline QImage imageOf(QwtPlot &plot)
{
    return plot.canvas()->grab().toImage();
}

/// Opaque, so that it compares with a theme's colours.
inline QRgb colourAt(const QImage &image, const QPointF &position)
{
    return image.pixel(position.toPoint()) | 0xff000000;
}

/// The pixels of a part of an image whose opaque colours are wanted.
template <class IsWanted>
QPolygon pixelsWhere(const QImage &image, const QRect &part, IsWanted isWanted)
{
    QPolygon pixels;
    for (int y = part.top(); y <= part.bottom(); ++y)
        for (int x = part.left(); x <= part.right(); ++x)
            if (isWanted(image.pixel(x, y) | 0xff000000))
                pixels << QPoint(x, y);
    return pixels;
}

inline QSet<QRgb> coloursOf(const QImage &image)
{
    QSet<QRgb> colours;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            colours.insert(image.pixel(x, y) | 0xff000000);
    return colours;
}

inline QSet<QRgb> coloursOf(QwtPlot &plot)
{
    return coloursOf(imageOf(plot));
}

} // namespace faintline::test
