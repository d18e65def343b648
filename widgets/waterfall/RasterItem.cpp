#include "widgets/waterfall/RasterItem.h"

#include "widgets/base/deviceRect.h"

#include <qwt_plot.h>
#include <qwt_scale_map.h>

#include <QPainter>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace faintline {

namespace {

    constexpr int blockSize = 32; ///< of transposition

    /// Rounds to 40 binary digits, so that scrolling does not change the pixel width by rounding errors.
    double steadied(double step)
    {
        int exponent = 0;
        const double mantissa = std::frexp(step, &exponent);
        return std::ldexp(std::round(std::ldexp(mantissa, 40)), exponent - 40);
    }

    /// Pixels over an axis, on a grid that starts with the axis.
    PixelRow pixelRow(const Span &span, int count, const Axis &axis)
    {
        const double step = steadied(span.width() / count / axis.step);
        const double first = axis.position(span.low) + 0.5;
        return {std::round(first / step) * step, step, count};
    }

    /// The same on a logarithmic scale.
    PixelRow logarithmicRow(const Span &span, int count, const Axis &axis)
    {
        const double step = steadied(std::log(span.high / span.low) / count);
        const double first = std::log(span.low / axis.step);
        return {std::round(first / step) * step, step, count, axis.position(0.0) + 0.5};
    }

    /// Number of pixels by which a row has moved; nothing if it is a different row.
    std::optional<int> shiftOf(const PixelRow &from, const PixelRow &to)
    {
        if (from.step != to.step || from.count != to.count || from.zero != to.zero)
            return {};
        const double shift = std::round(to.first / to.step) - std::round(from.first / from.step);
        return std::abs(shift) < to.count ? std::optional(int(shift)) : std::nullopt;
    }

    /// `count` pixels of a row, starting with its pixel `begin`.
    PixelRow part(const PixelRow &row, int begin, int count)
    {
        return {(std::round(row.first / row.step) + begin) * row.step, row.step, count, row.zero};
    }

    /// Transposes rows and columns, by blocks that fit into the cache.
    void transpose(const std::vector<std::uint8_t> &from, int rows, int columns, std::vector<std::uint8_t> &to)
    {
        to.resize(from.size());
        const auto at = [](int row, int column, int width) {
            return std::size_t(row) * std::size_t(width) + std::size_t(column);
        };
        for (int r0 = 0; r0 < rows; r0 += blockSize)
            for (int c0 = 0; c0 < columns; c0 += blockSize)
                for (int r = r0; r < std::min(r0 + blockSize, rows); ++r)
                    for (int c = c0; c < std::min(c0 + blockSize, columns); ++c)
                        to[at(c, r, rows)] = from[at(r, c, columns)];
    }

    /// The maximum of each pixel's four neighbours.
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

RasterItem::RasterItem()
{
    setZ(0.0);
}

void RasterItem::setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &frequency)
{
    const Axis time = picture ? picture->time() : Axis();
    setPicture(std::move(picture), frequency, time);
}

void RasterItem::setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &frequency, const Axis &time)
{
    m_picture = std::move(picture);
    m_frequency = frequency;
    m_time = time;
    m_bytesKey = {};
}

void RasterItem::draw(const PixelRow &time, const PixelRow &cells, int level, std::span<std::uint8_t> out) const
{
    const auto first = Index(std::lround(m_time.position(m_picture->time().first)));
    rasterise(*m_picture, level, time, cells, out, {first, m_time.count});
}

void RasterItem::updateBytes(const PixelRow &time, const PixelRow &cells) const
{
    const BytesKey key{m_picture.get(), time, cells};
    if (key == m_bytesKey)
        return;
    const auto down = shiftOf(m_bytesKey.time, time);
    const auto right = shiftOf(m_bytesKey.cells, cells);
    if (key.picture == m_bytesKey.picture && down && right) {
        scroll(time, cells, *down, *right);
    } else {
        m_bytes.resize(std::size_t(time.count) * std::size_t(cells.count));
        draw(time, cells, levelToRead(*m_picture, time, cells), m_bytes);
    }
    m_bytesKey = key;
    m_imageKey.reset();
}

/// Moves pixels that remain visible and draws new ones: whole lines, then the sides of the others.
void RasterItem::scroll(const PixelRow &time, const PixelRow &cells, int down, int right) const
{
    const int level = levelToRead(*m_picture, time, cells);
    const auto line = [&](int row) { return m_bytes.data() + std::ptrdiff_t(row) * cells.count; };
    const int firstKept = std::max(-down, 0);
    const int endKept = time.count - std::max(down, 0);
    const int width = cells.count - std::abs(right);
    for (int i = firstKept; i < endKept; ++i) {
        const int row = down >= 0 ? i : firstKept + endKept - 1 - i; // the order avoids overwriting pixels that are
                                                                     // still to be moved
        std::memmove(line(row) + std::max(-right, 0), line(row + down) + std::max(right, 0), std::size_t(width));
    }
    if (down != 0) {
        const int first = down > 0 ? endKept : 0;
        draw(part(time, first, std::abs(down)), cells, level,
             std::span(m_bytes).subspan(std::size_t(first) * std::size_t(cells.count),
                                        std::size_t(std::abs(down)) * std::size_t(cells.count)));
    }
    if (right != 0) {
        const int first = right > 0 ? width : 0;
        const int rows = endKept - firstKept;
        std::vector<std::uint8_t> side(std::size_t(rows) * std::size_t(std::abs(right)));
        draw(part(time, firstKept, rows), part(cells, first, std::abs(right)), level, side);
        for (int i = 0; i < rows; ++i)
            std::copy_n(side.data() + std::ptrdiff_t(i) * std::abs(right), std::abs(right),
                        line(firstKept + i) + first);
    }
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
        return bytes.data() + std::ptrdiff_t(key.isUpward ? lastRow - shown : shown) * size.width();
    };

    if (m_image.size() != size)
        m_image = QImage(size, QImage::Format_RGB32);
    const std::array<QRgb, 256> table = key.colours.table(m_picture->scale());
    const int contourByte = key.colours.contourByte(m_picture->scale());
    std::vector<std::uint8_t> highest(std::size_t(size.width()));
    for (int y = 0; y <= lastRow; ++y) {
        const std::uint8_t *from = row(y);
        auto *to = reinterpret_cast<QRgb *>(m_image.scanLine(y));
        for (int x = 0; x < size.width(); ++x)
            to[x] = table[from[x]];
        if (contourByte > 255)
            continue;
        raiseNeighbours(row(y - 1), from, row(y + 1), highest);
        for (int x = 0; x < size.width(); ++x) {
            const bool isBeside = (from[x] < contourByte) & (highest[std::size_t(x)] >= contourByte);
            to[x] = isBeside ? key.colours.contourColour : to[x];
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
    updateBytes(pixelRow(time, m_isTimeVertical ? size.height() : size.width(), m_time),
                (m_isLogarithmic ? logarithmicRow
                                 : pixelRow)(frequency, m_isTimeVertical ? size.width() : size.height(), m_frequency));
    paint({isUpward, m_isTimeVertical, m_colours}, size);
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
