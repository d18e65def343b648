#include "widgets/pings/PolarItem.h"

#include "widgets/base/deviceRect.h"
#include "widgets/base/rasterise.h"
#include "widgets/pings/visitPolar.h"

#include <qwt_plot.h>
#include <qwt_scale_map.h>

#include <QImage>
#include <QPainter>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace faintline {

namespace {

    constexpr int nothing = -1; ///< no cell

} // namespace

PolarItem::PolarItem()
{
    setZ(0.0);
}

void PolarItem::setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &bearing)
{
    m_picture = std::move(picture);
    m_bearing = bearing;
}

QImage PolarItem::image(const Span &x, const Span &y, const QSize &size) const
{
    if (!m_picture || m_picture->cells() == 0 || size.isEmpty())
        return {};
    const Axis &range = m_picture->time();
    const double perPixel = x.width() / size.width();
    const double cellsPerPixel = perPixel / range.step;
    // Rings one pixel wide, starting at the first cell's near side.
    const int rings = std::max(1, int(std::ceil(double(range.count) / cellsPerPixel)));
    std::vector<std::uint8_t> bytes(std::size_t(rings) * std::size_t(m_bearing.count));
    rasterise(*m_picture, {0.0, cellsPerPixel, rings}, {0.0, 1.0, int(m_bearing.count)}, bytes);

    std::vector<int> values(std::size_t(size.width()) * std::size_t(size.height()), nothing);
    visitPolar(x, y, size, range, m_bearing, [&](std::size_t pixel, double distance, Index beam) {
        if (const auto ring = Index(distance / perPixel); ring < rings)
            values[pixel] = bytes[std::size_t(ring * m_bearing.count + beam)];
    });

    const std::array<QRgb, 256> table = m_colours.table(m_picture->scale());
    const int contourByte = m_colours.contourByte(m_picture->scale());
    QImage image(size, QImage::Format_RGB32);
    const auto at = [&](int row, int column) {
        const int r = std::clamp(row, 0, size.height() - 1), c = std::clamp(column, 0, size.width() - 1);
        return values[std::size_t(r) * std::size_t(size.width()) + std::size_t(c)];
    };
    for (int row = 0; row < size.height(); ++row) {
        auto *line = reinterpret_cast<QRgb *>(image.scanLine(row));
        for (int column = 0; column < size.width(); ++column) {
            const int here = at(row, column);
            line[column] = here == nothing ? m_ground.rgb() : table[std::size_t(here)];
            if (here != nothing && here < contourByte && contourByte < 256
                && std::max({at(row - 1, column), at(row + 1, column), at(row, column - 1), at(row, column + 1)})
                       >= contourByte)
                line[column] = m_colours.contourColour;
        }
    }
    return image;
}

void PolarItem::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
                     const QRectF &canvasRect) const
{
    const DeviceRect place = deviceRect(*painter, canvasRect);
    const QRectF &rect = place.rect;
    const QImage picture = image({xMap.invTransform(rect.left()), xMap.invTransform(rect.right())},
                                 {yMap.invTransform(rect.bottom()), yMap.invTransform(rect.top())}, place.pixels);
    if (!picture.isNull())
        drawOnPixels(*painter, place, picture);
}

} // namespace faintline
