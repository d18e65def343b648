#include "widgets/RasterItem.h"

#include "widgets/deviceRect.h"

#include <qwt_plot.h>
#include <qwt_scale_map.h>

#include <QPainter>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr int blockSize = 32; ///< of transposition

    /// Pixels over an axis, on a grid that starts with the axis.
    PixelRow pixelRow(const Span &span, int count, const Axis &axis)
    {
        const double step = span.width() / count / axis.step;
        const double first = axis.position(span.low) + 0.5;
        return {std::round(first / step) * step, step, count};
    }

    /// Rows ↔ columns, by blocks that stay in the cache.
    void transpose(const std::vector<std::uint8_t> &from, int rows, int columns, std::vector<std::uint8_t> &to)
    {
        to.resize(from.size());
        const auto at = [](int row, int column, int width) {
            return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
        };
        for (int r0 = 0; r0 < rows; r0 += blockSize)
            for (int c0 = 0; c0 < columns; c0 += blockSize)
                for (int r = r0; r < std::min(r0 + blockSize, rows); ++r)
                    for (int c = c0; c < std::min(c0 + blockSize, columns); ++c)
                        to[at(c, r, rows)] = from[at(r, c, columns)];
    }

    /// The highest of each pixel's four neighbours.
    void raiseNeighbours(const std::uint8_t *above, const std::uint8_t *here, const std::uint8_t *below,
                         std::vector<std::uint8_t> &highest)
    {
        const std::size_t last = highest.size() - 1;
        for (std::size_t x = 0; x <= last; ++x)
            highest[x] = std::max(above[x], below[x]);
        for (std::size_t x = 1; x <= last; ++x)
            highest[x] = std::max(highest[x], here[x - 1]);
        for (std::size_t x = 0; x < last; ++x)
            highest[x] = std::max(highest[x], here[x + 1]);
    }

} // namespace

RasterItem::RasterItem() : m_map(&ColourMap::named(ColourMap::defaultName()))
{
    setZ(0.0);
}

void RasterItem::setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &frequency)
{
    m_picture = std::move(picture);
    m_frequency = frequency;
    m_bytesKey = {};
}

void RasterItem::setColours(const ColourMap &map, const Span &range)
{
    m_map = &map;
    m_range = range;
}

void RasterItem::setContour(std::optional<double> value, QRgb colour)
{
    m_contour = value;
    m_contourColour = colour;
}

std::vector<QRgb> RasterItem::colourTable() const
{
    std::vector<QRgb> table(256);
    for (int byte = 0; byte < 256; ++byte)
        table[static_cast<std::size_t>(byte)] =
            m_map->at((m_picture->scale().value(byte) - m_range.low) / m_range.width());
    return table;
}

void RasterItem::updateBytes(const PixelRow &time, const PixelRow &cells) const
{
    const BytesKey key{m_picture.get(), time, cells};
    if (key == m_bytesKey)
        return;
    m_bytes.resize(static_cast<std::size_t>(time.count) * static_cast<std::size_t>(cells.count));
    rasterise(*m_picture, time, cells, m_bytes);
    m_bytesKey = key;
    m_imageKey.reset();
}

void RasterItem::paint(const ImageKey &key, const QSize &size) const
{
    if (m_imageKey == key && m_image.size() == size)
        return;
    std::vector<std::uint8_t> transposed;
    if (!key.isTimeVertical)
        transpose(m_bytes, size.width(), size.height(), transposed);
    const std::vector<std::uint8_t> &bytes = key.isTimeVertical ? m_bytes : transposed;
    const int lastRow = size.height() - 1;
    const auto row = [&](int y) {
        const int shown = std::clamp(y, 0, lastRow);
        return bytes.data() + static_cast<std::ptrdiff_t>(key.isUpward ? lastRow - shown : shown) * size.width();
    };

    if (m_image.size() != size)
        m_image = QImage(size, QImage::Format_RGB32);
    const std::vector<QRgb> table = colourTable();
    std::vector<std::uint8_t> highest(static_cast<std::size_t>(size.width()));
    for (int y = 0; y <= lastRow; ++y) {
        const std::uint8_t *from = row(y);
        auto *to = reinterpret_cast<QRgb *>(m_image.scanLine(y));
        for (int x = 0; x < size.width(); ++x)
            to[x] = table[from[x]];
        if (key.contourByte > 255)
            continue;
        raiseNeighbours(row(y - 1), from, row(y + 1), highest);
        for (int x = 0; x < size.width(); ++x) {
            const bool isBeside =
                (from[x] < key.contourByte) & (highest[static_cast<std::size_t>(x)] >= key.contourByte);
            to[x] = isBeside ? key.contourColour : to[x];
        }
    }
    m_imageKey = key;
}

QImage RasterItem::image(const Span &x, const Span &y, bool isUpward, const QSize &size) const
{
    if (!m_picture || m_picture->cells() == 0 || size.isEmpty())
        return {};
    const Span &time = m_isTimeVertical ? y : x;
    const Span &frequency = m_isTimeVertical ? x : y;
    updateBytes(pixelRow(time, m_isTimeVertical ? size.height() : size.width(), m_picture->time()),
                pixelRow(frequency, m_isTimeVertical ? size.width() : size.height(), m_frequency));
    const int contourByte = m_contour ? m_picture->scale().byte(*m_contour) : 256;
    paint({isUpward, m_isTimeVertical, m_map, m_range, contourByte, m_contourColour}, size);
    return m_image;
}

void RasterItem::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
                      const QRectF &canvasRect) const
{
    const DeviceRect place = deviceRect(*painter, canvasRect);
    const QRectF &rect = place.rect;
    const auto span = [](const QwtScaleMap &map, double a, double b) {
        const double p = map.invTransform(a), q = map.invTransform(b);
        return Span{std::min(p, q), std::max(p, q)};
    };
    const bool isUpward = yMap.invTransform(rect.bottom()) < yMap.invTransform(rect.top());
    const QImage picture =
        image(span(xMap, rect.left(), rect.right()), span(yMap, rect.top(), rect.bottom()), isUpward, place.pixels);
    if (!picture.isNull())
        drawOnPixels(*painter, place, picture);
}

} // namespace faintline
