#include "widgets/plot/ChartItems.h"

#include "widgets/base/labelText.h"

#include <qwt_interval_symbol.h>
#include <qwt_plot_curve.h>
#include <qwt_plot_intervalcurve.h>
#include <qwt_plot_marker.h>
#include <qwt_symbol.h>
#include <qwt_text.h>

#include <QPainter>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    constexpr std::size_t mostBars = 24;    ///< more points are drawn as a band
    constexpr std::size_t mostMarkers = 60; ///< more points are drawn as a line only, or as small points

    constexpr std::array<QwtSymbol::Style, 8> symbols{QwtSymbol::Ellipse,   QwtSymbol::Rect,      QwtSymbol::Diamond,
                                                      QwtSymbol::UTriangle, QwtSymbol::DTriangle, QwtSymbol::XCross,
                                                      QwtSymbol::LTriangle, QwtSymbol::RTriangle};

    std::unique_ptr<QwtSymbol> symbolOf(Curve::Kind kind, std::size_t style, const QColor &colour, const QColor &canvas,
                                        int size = 7)
    {
        const bool isHollow = kind == Curve::Kind::Paper;
        return std::make_unique<QwtSymbol>(symbols[style % symbols.size()], QBrush(isHollow ? canvas : colour),
                                           QPen(colour, 1.4), QSize(size, size));
    }

    QPen penOf(Curve::Kind kind, const QColor &colour)
    {
        return QPen(colour, 1.6, kind == Curve::Kind::Theory ? Qt::DashLine : Qt::SolidLine);
    }

    double decadesOf(double value)
    {
        return std::log10(std::max(value, std::numeric_limits<double>::min()));
    }

} // namespace

double ChartItems::abscissa(double x) const
{
    return m_chart.isLogarithmicX ? decadesOf(x) : x;
}

double ChartItems::ordinate(double y) const
{
    return m_chart.isLogarithmicY ? decadesOf(y) : y;
}

/// Index of colour and symbol: that of the measured curve to which a curve belongs; nothing if it belongs to none.
std::optional<std::size_t> ChartItems::styleOf(std::size_t curve) const
{
    const auto countBefore = [this](std::size_t end) {
        return std::size_t(std::count_if(m_chart.curves.begin(), m_chart.curves.begin() + std::ptrdiff_t(end),
                                         [](const Curve &c) { return c.kind == Curve::Kind::Measured; }));
    };
    if (isMeasured(curve))
        return countBefore(curve);
    std::size_t longest = 0;
    std::optional<std::size_t> owner;
    for (std::size_t i = 0; i < m_chart.curves.size(); ++i) {
        const std::string &name = m_chart.curves[i].name;
        if (isMeasured(i) && name.size() >= longest && m_chart.curves[curve].name.starts_with(name)) {
            longest = name.size();
            owner = i;
        }
    }
    return owner ? std::optional(countBefore(*owner)) : std::nullopt;
}

/// Symbols distinguish curves that belong to no measured curve.
std::size_t ChartItems::symbolStyleOf(std::size_t curve) const
{
    if (const auto style = styleOf(curve))
        return *style;
    std::size_t before = 0;
    for (std::size_t i = 0; i < curve; ++i)
        before += m_chart.curves[i].kind == Curve::Kind::Paper && !styleOf(i) ? 1 : 0;
    return before;
}

QColor ChartItems::colourOf(std::size_t curve) const
{
    const auto style = styleOf(curve);
    return style ? m_colours.curves[*style % std::size(m_colours.curves)] : m_colours.text;
}

std::unique_ptr<QwtPlotCurve> ChartItems::curve(std::size_t index) const
{
    const Curve &curve = m_chart.curves[index];
    const QColor colour = colourOf(index);
    auto item = std::make_unique<QwtPlotCurve>(labelText(curve.name));
    item->setRenderHint(QwtPlotItem::RenderAntialiased);
    item->setPen(penOf(curve.kind, colour));
    item->setZ(curve.kind == Curve::Kind::Theory ? 20.0 : 30.0);
    if (curve.kind == Curve::Kind::Paper)
        item->setStyle(QwtPlotCurve::NoCurve);
    const bool areMany = curve.points.size() > mostMarkers;
    if (curve.kind == Curve::Kind::Paper || (curve.kind == Curve::Kind::Measured && !areMany))
        item->setSymbol(
            symbolOf(curve.kind, symbolStyleOf(index), colour, m_colours.canvas, areMany ? 4 : 7).release());
    QPolygonF samples;
    for (const Curve::Point &point : curve.points)
        samples << place(point);
    item->setSamples(samples);
    return item;
}

/// Placed above the points, or below those near the top.
std::vector<std::unique_ptr<QwtPlotMarker>> ChartItems::labels(std::size_t index) const
{
    double highest = 0.0;
    for (const Curve::Point &point : m_chart.curves[index].points)
        highest = std::max(highest, point.y);
    std::vector<std::unique_ptr<QwtPlotMarker>> result;
    for (const Curve::Point &point : m_chart.curves[index].points) {
        if (point.label.empty())
            continue;
        QwtText text(labelText(point.label), QwtText::PlainText);
        text.setFont(Theme::plotFont());
        text.setColor(m_colours.text);
        auto item = std::make_unique<QwtPlotMarker>();
        item->setLabel(text);
        item->setLabelAlignment(Qt::AlignRight | (point.y > 0.85 * highest ? Qt::AlignBottom : Qt::AlignTop));
        item->setSpacing(4);
        item->setValue(place(point));
        item->setZ(25.0);
        result.push_back(std::move(item));
    }
    return result;
}

std::unique_ptr<QwtPlotItem> ChartItems::intervals(std::size_t index) const
{
    const Curve &curve = m_chart.curves[index];
    const QColor colour = colourOf(index);
    QVector<QwtIntervalSample> samples;
    for (const Curve::Point &point : curve.points)
        if (point.interval.low < point.interval.high)
            samples << QwtIntervalSample(abscissa(point.x), ordinate(point.interval.low),
                                         ordinate(point.interval.high));
    if (samples.isEmpty())
        return nullptr;
    auto item = std::make_unique<QwtPlotIntervalCurve>();
    item->setRenderHint(QwtPlotItem::RenderAntialiased);
    item->setSamples(samples);
    item->setPen(QPen(Qt::NoPen));
    item->setZ(10.0);
    if (curve.points.size() > mostBars) {
        QColor band = colour;
        band.setAlpha(46);
        item->setStyle(QwtPlotIntervalCurve::Tube);
        item->setBrush(band);
    } else {
        item->setStyle(QwtPlotIntervalCurve::NoCurve);
        auto *bar = new QwtIntervalSymbol(QwtIntervalSymbol::Bar);
        bar->setWidth(5);
        bar->setPen(QPen(colour, 1.0));
        item->setSymbol(bar);
    }
    return item;
}

QPixmap ChartItems::sample(std::size_t index, double devicePixelRatio) const
{
    const Curve &curve = m_chart.curves[index];
    const QColor colour = colourOf(index);
    QPixmap pixmap(QSize(26, 12) * devicePixelRatio);
    pixmap.setDevicePixelRatio(devicePixelRatio);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(penOf(curve.kind, colour));
    if (curve.kind != Curve::Kind::Paper)
        painter.drawLine(QPointF(1, 6), QPointF(25, 6));
    if (curve.kind != Curve::Kind::Theory)
        symbolOf(curve.kind, symbolStyleOf(index), colour, m_colours.canvas)->drawSymbol(&painter, QPointF(13, 6));
    return pixmap;
}

} // namespace faintline
