#include "widgets/base/deviceRect.h"

#include <QImage>
#include <QPainter>
#include <QTransform>

#include <cmath>

namespace faintline {

DeviceRect deviceRect(const QPainter &painter, const QRectF &rect)
{
    const QRect aligned = rect.toAlignedRect();
    const double ratio = painter.device()->devicePixelRatioF();
    const QTransform toDevice = painter.deviceTransform();
    if (ratio == std::floor(ratio) || toDevice.m11() != ratio || toDevice.m22() != ratio)
        return {QRectF(aligned), (QSizeF(aligned.size()) * ratio).toSize()};
    constexpr double hair = 1e-6; // tolerance for rounding errors of integers
    const QRect pixels = toDevice.mapRect(QRectF(aligned)).adjusted(hair, hair, -hair, -hair).toAlignedRect();
    return {toDevice.inverted().mapRect(QRectF(pixels)), pixels.size()};
}

void drawOnPixels(QPainter &painter, const DeviceRect &place, const QImage &image)
{
    const bool isBroken = place.rect != QRectF(place.rect.toRect());
    if (isBroken) {
        painter.save();
        painter.setClipRect(place.rect);
    }
    painter.drawImage(place.rect, image);
    if (isBroken)
        painter.restore();
}

} // namespace faintline
