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

/// The smallest one that covers a rectangle. An image of that many pixels drawn there is not resampled and leaves no
/// gaps at the edges, even if a window pixel is 1.25 screen pixels. On a device without pixels of its own (a drawing) a
/// pixel is one unit.
DeviceRect deviceRect(const QPainter &painter, const QRectF &rect);

/// Draws an image of that many pixels there. The clip is extended to whole pixels, so that the outermost ones are not
/// omitted.
void drawOnPixels(QPainter &painter, const DeviceRect &place, const QImage &image);

} // namespace faintline
