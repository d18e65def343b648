#pragma once

#include <QRectF>
#include <QSize>

class QImage;
class QPainter;

namespace faintline {

/// A rectangle of whole device pixels.
struct DeviceRect {
    QRectF rect;  ///< in the painter's coordinates
    QSize pixels; ///< of the device
};

/// The smallest one that covers a rectangle: an image of so many pixels drawn there keeps each of its own, without gaps
/// at the edges, also where a pixel of the window is 1.25 of the screen's. On a device without pixels of its own (a
/// drawing) a pixel is one unit.
DeviceRect deviceRect(const QPainter &painter, const QRectF &rect);

/// Draws an image of that many pixels there. A clip that ends within a pixel would leave out the outermost ones: it is
/// made wider.
void drawOnPixels(QPainter &painter, const DeviceRect &place, const QImage &image);

} // namespace faintline
