#include "widgets/plot/CellPicture.h"

#include "widgets/base/Theme.h"
#include "widgets/base/deviceRect.h"
#include "widgets/base/labelText.h"
#include "widgets/base/scaleTicks.h"
#include "widgets/plot/ColourMap.h"
#include "widgets/plot/CurveKey.h"
#include "widgets/plot/NumberScaleDraw.h"

#include <qwt_color_map.h>
#include <qwt_interval.h>
#include <qwt_plot_item.h>
#include <qwt_scale_map.h>
#include <qwt_scale_widget.h>

#include <QImage>
#include <QPainter>

#include <algorithm>
#include <limits>

namespace faintline {

namespace {

    Span outline(const Axis &axis)
    {
        const double a = axis.value(-0.5);
        const double b = axis.value(double(axis.count) - 0.5);
        return {std::min(a, b), std::max(a, b)};
    }

    /// First cell of a pixel and number of cells.
    struct Cells {
        Index first;
        Index count;
    };
    Cells cellsOf(int pixel, int pixels, Index cells)
    {
        const auto share = double(cells) / pixels;
        const auto first = std::min(cells - 1, Index(pixel * share));
        const auto end = std::min(cells, std::max(first + 1, Index((pixel + 1) * share)));
        return {first, end - first};
    }

} // namespace

/// Paints the cells and the overlays.
class CellPicture::PictureItem : public QwtPlotItem
{
public:
    explicit PictureItem(const CellPicture &owner) : m_owner(owner) { setZ(10.0); }

    void forget() { m_image = {}; }

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap, const QRectF &) const override
    {
        if (m_owner.values().empty())
            return;
        const Span x = outline(m_owner.m_xAxis);
        const Span y = outline(m_owner.yAxis());
        // Aligned to whole pixels, because fractional scaling would drop some of the image's.
        const QRect place = QRectF(QPointF(xMap.transform(x.low), yMap.transform(y.high)),
                                   QPointF(xMap.transform(x.high), yMap.transform(y.low)))
                                .normalized()
                                .toRect();
        const auto [rect, pixels] = deviceRect(*painter, place);
        paint(pixels);
        painter->save();
        painter->drawImage(rect, m_image);
        painter->setRenderHint(QPainter::Antialiasing);
        for (const Path &path : m_owner.m_paths)
            drawPath(*painter, path, xMap, yMap);
        painter->restore();
    }

private:
    void paint(const QSize &wanted) const
    {
        const QSize size = wanted.expandedTo({1, 1});
        if (m_image.size() == size)
            return;
        m_image = QImage(size, QImage::Format_RGB32);
        const ColourMap &map = ColourMap::named(ColourMap::defaultName());
        const Index rows = m_owner.yAxis().count;
        for (int py = 0; py < size.height(); ++py) {
            auto *line = reinterpret_cast<QRgb *>(m_image.scanLine(py));
            const Cells down = cellsOf(size.height() - 1 - py, size.height(), rows);
            for (int px = 0; px < size.width(); ++px) {
                const Cells across = cellsOf(px, size.width(), m_owner.m_xAxis.count);
                float highest = -std::numeric_limits<float>::infinity();
                for (Index c = across.first; c < across.first + across.count; ++c) {
                    const float *column = m_owner.values().data() + c * rows + down.first;
                    highest = std::max(highest, *std::max_element(column, column + down.count));
                }
                line[px] = map.at((double(highest) - m_owner.m_range.low) / m_owner.m_range.width());
            }
        }
    }

    static void drawPath(QPainter &painter, const Path &path, const QwtScaleMap &xMap, const QwtScaleMap &yMap)
    {
        QPolygonF points;
        for (const QPointF &point : path.points)
            points << QPointF(xMap.transform(point.x()), yMap.transform(point.y()));
        painter.setBrush(Qt::NoBrush);
        // A dark outline below makes the path visible on bright cells; dashes show the cells between them.
        for (const bool isSeam : {true, false}) {
            if (isSeam && path.kind == Path::Kind::Dashes)
                continue;
            painter.setPen(QPen(isSeam ? QColor(0, 0, 0, 150) : path.colour, isSeam ? 3.6 : 1.8,
                                path.kind == Path::Kind::Dashes ? Qt::DashLine : Qt::SolidLine));
            switch (path.kind) {
            case Path::Kind::Line:
            case Path::Kind::Dashes:
                painter.drawPolyline(points);
                break;
            case Path::Kind::Rings:
                for (const QPointF &point : points)
                    painter.drawEllipse(point, 9.0, 9.0);
                break;
            case Path::Kind::Crosses:
                for (const QPointF &point : points) {
                    painter.drawLine(point - QPointF(6.0, 6.0), point + QPointF(6.0, 6.0));
                    painter.drawLine(point - QPointF(6.0, -6.0), point + QPointF(6.0, -6.0));
                }
                break;
            }
        }
    }

    const CellPicture &m_owner;
    mutable QImage m_image; ///< of the canvas's size; recreated when that or the picture changes
};

CellPicture::CellPicture(QWidget *parent)
    : MarkedPlot(parent), m_item(new PictureItem(*this)), m_key(new CurveKey(Qt::AlignTop | Qt::AlignLeft))
{
    m_item->attach(this);
    m_key->attach(this);
    setAxisScaleDraw(QwtAxis::YRight, new NumberScaleDraw);
    CellPicture::restyle();
}

void CellPicture::setPicture(const Axis &x, const Axis &y, std::vector<float> values, const Span &range,
                             const QString &title)
{
    m_xAxis = x;
    m_yAxis = y;
    m_values = std::move(values);
    m_range = range;
    m_title = title;
    m_item->forget();
    const auto titleOf = [](const Axis &axis) {
        const QString name = labelText(axis.name, mostUnitLetters);
        return axis.unit.empty() ? name : QStringLiteral("%1 (%2)").arg(name, labelText(axis.unit, mostUnitLetters));
    };
    setAxisTitle(QwtAxis::XBottom, titleOf(x));
    setAxisTitle(QwtAxis::YLeft, titleOf(y));
    setEmpty(m_values.empty());
    CellPicture::restyle();
    if (!m_values.empty())
        setSpans(outline(x), outline(y));
}

void CellPicture::setPaths(std::vector<Path> paths)
{
    m_paths = std::move(paths);
    CellPicture::restyle();
}

void CellPicture::clear()
{
    m_paths.clear();
    setPicture({}, {}, {}, {0.0, 1.0}, {});
}

void CellPicture::restyle()
{
    const bool hasPicture = !m_values.empty();
    setAxisVisible(QwtAxis::YRight, hasPicture);
    if (hasPicture) {
        setAxisTitle(QwtAxis::YRight, m_title);
        setAxisScaleDiv(QwtAxis::YRight, linearScaleDiv(m_range, 5));
        QwtScaleWidget *bar = axisWidget(QwtAxis::YRight);
        bar->setColorBarEnabled(true);
        bar->setColorBarWidth(12);
        auto *colours = new QwtLinearColorMap(QwtColorMap::RGB);
        const ColourMap &map = ColourMap::named(ColourMap::defaultName());
        colours->setColorInterval(QColor(map.at(0.0)), QColor(map.at(1.0)));
        for (int stop = 1; stop < 32; ++stop)
            colours->addColorStop(stop / 32.0, QColor(map.at(stop / 32.0)));
        bar->setColorMap(QwtInterval(m_range.low, m_range.high), colours);
    }
    MarkedPlot::restyle();
    m_key->entries.clear();
    m_key->textColour = Qt::white;
    m_key->plate = QColor(0, 0, 0, 150);
    for (const Path &path : m_paths)
        if (!path.points.empty())
            m_key->entries.push_back(
                {path.name, QPen(path.colour, 2.0, path.kind == Path::Kind::Dashes ? Qt::DashLine : Qt::SolidLine),
                 path.kind == Path::Kind::Rings || path.kind == Path::Kind::Crosses});
    m_key->setVisible(hasPicture && !m_key->entries.empty());
    replot();
}

} // namespace faintline
