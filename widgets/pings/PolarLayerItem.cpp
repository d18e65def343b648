#include "widgets/pings/PolarLayerItem.h"

#include "widgets/pings/visitPolar.h"

#include <qwt_scale_map.h>

#include <QImage>
#include <QPainter>

#include <cmath>

namespace faintline {

PolarLayerItem::PolarLayerItem(const LayerItem &layer) : m_layer(layer)
{
    setZ(layer.z());
}

void PolarLayerItem::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
                          const QRectF &canvasRect) const
{
    if (!m_layer.isShown())
        return;
    const double ratio = painter->device()->devicePixelRatioF();
    const QRect rect = canvasRect.toAlignedRect();
    const QSize size(int(std::lround(rect.width() * ratio)), int(std::lround(rect.height() * ratio)));
    const Span x{xMap.invTransform(rect.left()), xMap.invTransform(rect.right() + 1.0)};
    const Span y{yMap.invTransform(rect.bottom() + 1.0), yMap.invTransform(rect.top())};
    QImage image(size, QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::transparent);
    const LayerPicture &picture = *m_layer.picture();
    const auto *colours = reinterpret_cast<const QRgb *>(m_layer.image().constBits());
    auto *to = reinterpret_cast<QRgb *>(image.bits());
    const Axis &range = m_layer.rows();
    visitPolar(x, y, size, range, m_layer.columns(), [&](std::size_t pixel, double distance, Index beam) {
        if (const Index from = picture.pixelAt(Index(distance / range.step), beam); from >= 0)
            to[pixel] = colours[from];
    });
    painter->drawImage(QRectF(rect), image);
}

} // namespace faintline
