#include "widgets/waterfall/LayerItem.h"

#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"
#include "widgets/plot/ColourMap.h"

#include <qwt_scale_map.h>

#include <QFontMetricsF>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    bool isRate(OutputLayer layer)
    {
        return layer == OutputLayer::Rate || layer == OutputLayer::SecondRate;
    }

    constexpr QRgb noSlope = qRgb(110, 110, 110);
    constexpr QRgb inhibitedColour = qRgb(0, 170, 190);

} // namespace

LayerItem::LayerItem() : m_pictureMap(&ColourMap::named({}))
{
    setZ(2.0); // above the raster, below the grid and the marks
}

void LayerItem::setPicture(std::shared_ptr<const LayerPicture> picture, const Axis &rows, const Axis &columns)
{
    m_picture = std::move(picture);
    m_rows = rows;
    m_columns = columns;
    m_image = {};
}

void LayerItem::setLayer(OutputLayer layer, const Span &range, const QString &title, double divisor)
{
    m_layer = layer;
    m_range = range;
    m_title = title;
    m_divisor = divisor;
    m_image = {};
}

void LayerItem::setOverlay(bool isOverlay, double opaqueNats)
{
    m_isOverlay = isOverlay;
    m_opaqueNats = std::max(opaqueNats, 1.0);
    m_image = {};
}

void LayerItem::setColours(const QColor &text, const QColor &plate, const ColourMap &map)
{
    if (&map != m_pictureMap)
        m_image = {};
    m_pictureMap = &map;
    m_text = text;
    m_plate = plate;
}

const ColourMap &LayerItem::map() const
{
    if (m_layer == OutputLayer::Presence && !m_isOverlay)
        return *m_pictureMap;
    return ColourMap::named(isRate(m_layer) ? QStringLiteral("blue-red") : QStringLiteral("viridis"));
}

QRgb LayerItem::colourOf(std::size_t pixel) const
{
    const auto value = double(m_picture->values(m_layer)[pixel]);
    const auto clear = [](QRgb colour, double opacity) {
        return qPremultiply(qRgba(qRed(colour), qGreen(colour), qBlue(colour), int(std::lround(255.0 * opacity))));
    };
    if (m_layer == OutputLayer::Inhibited)
        return value > 0.0 ? clear(inhibitedColour, m_isOverlay ? 0.55 : 1.0)
                           : clear(qRgb(0, 0, 0), m_isOverlay ? 0.0 : 1.0);
    if (isRate(m_layer) && m_picture->resetFraction[pixel] >= 1.0f) // all states were reset here: no rate has won
        return clear(noSlope, m_isOverlay ? 0.0 : 1.0);
    // If all possible rates are 0, use the middle of the colours, as in any other range.
    const QRgb colour = map().at(m_range.isEmpty() ? 0.5 : (value - m_range.low) / m_range.width());
    if (!m_isOverlay)
        return clear(colour, 1.0);
    if (m_layer == OutputLayer::Presence)
        return clear(colour, std::clamp(value, 0.0, 1.0));
    if (m_layer == OutputLayer::Reset)
        return clear(colour, 0.7 * std::clamp(value, 0.0, 1.0));
    return clear(colour, std::clamp(double(m_picture->statistic[pixel]) / m_opaqueNats, 0.0, 1.0));
}

const QImage &LayerItem::image() const
{
    if (!m_image.isNull())
        return m_image;
    m_image = QImage(int(m_picture->columns), int(m_picture->rows), QImage::Format_ARGB32_Premultiplied);
    std::size_t pixel = 0;
    for (int row = 0; row < m_image.height(); ++row) {
        auto *to = reinterpret_cast<QRgb *>(m_image.scanLine(row));
        for (int column = 0; column < m_image.width(); ++column)
            to[column] = colourOf(pixel++);
    }
    return m_image;
}

/// The columns as they lie on a scale that is not linear, one for each pixel.
QImage LayerItem::imageAlong(const QwtScaleMap &hz, const Span &pixels) const
{
    const QImage &from = image();
    QImage result(std::max(int(std::ceil(pixels.width())), 1), from.height(), from.format());
    result.fill(Qt::transparent);
    for (int x = 0; x < result.width(); ++x) {
        const double cell = std::floor(m_columns.position(hz.invTransform(pixels.low + x + 0.5)) + 0.5);
        const auto column = int(Index(cell) / m_picture->perColumn - m_picture->firstColumn);
        if (cell < 0.0 || column < 0 || column >= from.width())
            continue;
        for (int row = 0; row < from.height(); ++row)
            reinterpret_cast<QRgb *>(result.scanLine(row))[x] =
                reinterpret_cast<const QRgb *>(from.constScanLine(row))[column];
    }
    return result;
}

void LayerItem::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
                     const QRectF &canvasRect) const
{
    if (!isShown())
        return;
    const auto edge = [](const Axis &axis, Index cell) { return axis.value(double(cell) - 0.5); };
    const QwtScaleMap &timeMap = m_isTimeVertical ? yMap : xMap;
    const QwtScaleMap &hzMap = m_isTimeVertical ? xMap : yMap;
    const double time0 = timeMap.transform(edge(m_rows, m_picture->firstRow * m_picture->perRow));
    const double time1 = timeMap.transform(edge(m_rows, (m_picture->firstRow + 1) * m_picture->perRow));
    const bool isLinear = !hzMap.transformation();
    const Span canvas =
        m_isTimeVertical ? Span{canvasRect.left(), canvasRect.right()} : Span{canvasRect.top(), canvasRect.bottom()};
    const double hz0 =
        isLinear ? hzMap.transform(edge(m_columns, m_picture->firstColumn * m_picture->perColumn)) : canvas.low;
    const double hz1 =
        isLinear ? hzMap.transform(edge(m_columns, (m_picture->firstColumn + 1) * m_picture->perColumn)) : hz0 + 1.0;
    const QTransform place = m_isTimeVertical ? QTransform(hz1 - hz0, 0.0, 0.0, time1 - time0, hz0, time0)
                                              : QTransform(0.0, hz1 - hz0, time1 - time0, 0.0, time0, hz0);
    painter->save();
    painter->setClipRect(canvasRect, Qt::IntersectClip);
    painter->setTransform(place, true);
    painter->drawImage(0, 0, isLinear ? image() : imageAlong(hzMap, canvas));
    painter->restore();
}

class LayerItem::Key final : public QwtPlotItem
{
public:
    explicit Key(const LayerItem &owner) : m_owner(owner) { setZ(80.0); }

    void draw(QPainter *painter, const QwtScaleMap &, const QwtScaleMap &, const QRectF &canvasRect) const override
    {
        if (m_owner.m_picture && m_owner.m_layer != OutputLayer::Statistic)
            m_owner.drawKey(painter, canvasRect);
    }

private:
    const LayerItem &m_owner;
};

std::unique_ptr<QwtPlotItem> LayerItem::makeKey() const
{
    return std::make_unique<Key>(*this);
}

/// Draws a strip of the colours with the values at its ends and its title above.
void LayerItem::drawKey(QPainter *painter, const QRectF &canvas) const
{
    painter->save();
    painter->setFont(Theme::plotTitleFont());
    const QFontMetricsF metrics(painter->font());
    const bool isFlag = m_layer == OutputLayer::Inhibited;
    constexpr double margin = 6.0;
    const double width =
        std::min(std::max(140.0, metrics.horizontalAdvance(m_title)) + 16.0, canvas.width() - 2.0 * margin);
    const double height = isFlag ? metrics.height() + 8.0 : 2.0 * metrics.height() + 20.0;
    const QRectF plate(canvas.right() - width - margin, canvas.top() + margin, width, height);
    painter->setPen(Qt::NoPen);
    QColor ground = m_plate;
    ground.setAlpha(240);
    painter->setBrush(ground);
    painter->drawRoundedRect(plate, 3.0, 3.0);
    painter->setPen(m_text);
    const QRectF inner = plate.adjusted(8.0, 4.0, -8.0, -4.0);
    painter->drawText(QRectF(inner.left(), inner.top(), inner.width(), metrics.height()), Qt::AlignCenter,
                      metrics.elidedText(m_title, Qt::ElideMiddle, inner.width()));
    if (isFlag) {
        painter->fillRect(QRectF(plate.left() + 3.0, inner.top() + 3.0, 8.0, metrics.height() - 6.0),
                          QColor(inhibitedColour));
    } else {
        const QRectF strip(inner.left(), inner.top() + metrics.height() + 2.0, inner.width(), 9.0);
        for (int x = 0; x < int(strip.width()); ++x)
            painter->fillRect(QRectF(strip.left() + x, strip.top(), 1.0, strip.height()),
                              QColor(map().at(x / strip.width())));
        const QRectF numbers(inner.left(), strip.bottom() + 1.0, inner.width(), metrics.height());
        painter->drawText(numbers, Qt::AlignLeft, powerText(m_range.low / m_divisor, 3));
        painter->drawText(numbers, Qt::AlignHCenter, powerText(m_range.middle() / m_divisor, 3));
        painter->drawText(numbers, Qt::AlignRight, powerText(m_range.high / m_divisor, 3));
    }
    painter->restore();
}

} // namespace faintline
