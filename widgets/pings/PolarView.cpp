#include "widgets/pings/PolarView.h"

#include "widgets/base/labelText.h"
#include "widgets/base/quantities.h"
#include "widgets/base/scaleTicks.h"
#include "widgets/base/textPlate.h"
#include "widgets/pings/PingOverlayItem.h"
#include "widgets/pings/PolarItem.h"
#include "widgets/waterfall/waterfallCommands.h"

#include <qwt_plot_canvas.h>
#include <qwt_scale_map.h>
#include <qwt_text.h>

#include <QContextMenuEvent>
#include <QCoreApplication>
#include <QFontMetricsF>
#include <QKeyEvent>
#include <QMenu>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace faintline {

namespace {

    constexpr double degree = std::numbers::pi / 180.0;

    QPointF fromAbove(const PingMarks::Place &place)
    {
        return {place.along * std::sin(place.across * degree), place.along * std::cos(place.across * degree)};
    }

    /// Bounding box of a ring sector, seen from above.
    QRectF boundsOf(const Span &range, const Span &bearing)
    {
        const double r = range.high;
        if (bearing.width() > 180.0)
            return {-r, -r, 2.0 * r, 2.0 * r};
        constexpr int steps = 36;
        QPolygonF corners;
        for (int i = 0; i <= steps; ++i)
            for (const double edge : {range.low, range.high})
                corners << fromAbove({edge, bearing.low + bearing.width() * i / steps});
        return corners.boundingRect();
    }

} // namespace

/// Rings at round ranges, and a spoke every 30 degrees.
class PolarView::GridItem : public QwtPlotItem
{
public:
    GridItem() { setZ(5.0); }

    double longest = 1.0;
    double nearest = 0.0;
    QString unit;
    QColor line{255, 255, 255, 60};
    QColor text;

    void draw(QPainter *painter, const QwtScaleMap &x, const QwtScaleMap &y, const QRectF &rect) const override
    {
        painter->save();
        painter->setRenderHint(QPainter::Antialiasing);
        painter->setFont(Theme::plotFont());
        const auto at = [&](double range, double bearing) {
            const QPointF place = fromAbove({range, bearing});
            return QPointF(x.transform(place.x()), y.transform(place.y()));
        };
        const double pixels = std::abs(x.transform(1.0) - x.transform(0.0));
        const double visible = rect.width() / pixels;
        const bool isFar = longest >= 2000.0 && unit == QLatin1String("m");
        const QwtScaleDiv div = linearScaleDiv({0.0, std::min(longest, visible)}, 4);
        const double step = majorStep(div);
        painter->setPen(QPen(line, 1.0));
        painter->setBrush(Qt::NoBrush);
        for (double ring = step; ring < longest; ring += step)
            painter->drawEllipse(at(0.0, 0.0), ring * pixels, ring * pixels);
        for (int bearing = 0; bearing < 360; bearing += 30)
            painter->drawLine(at(nearest, bearing), at(longest, bearing));

        const auto write = [&](const QPointF &where, const QString &words) {
            const QFontMetricsF metrics(painter->font());
            const QRectF box(where - QPointF(0.5 * metrics.horizontalAdvance(words) + 3.0, 0.5 * metrics.height()),
                             QSizeF(metrics.horizontalAdvance(words) + 6.0, metrics.height()));
            if (rect.contains(box))
                drawOnPlate(*painter, box, words, QColor(235, 235, 235), QColor(0, 0, 0, 120));
        };
        for (double ring = step; ring < longest; ring += step)
            write(at(ring, 15.0), isFar ? numberText(ring / 1000.0, decimalsFor(step / 1000.0)) + QStringLiteral(" km")
                                        : numberText(ring, decimalsFor(step)) + QLatin1Char(' ') + unit);
        for (int bearing = 0; bearing < 360; bearing += 90)
            write(at(longest * 0.95, bearing), QString::number(bearing) + QChar(0xB0));
        painter->restore();
    }
};

PolarView::PolarView(WaterfallView &view, QWidget *parent)
    : ThemedPlot(parent), m_view(view), m_raster(new PolarItem), m_grid(new GridItem),
      m_overlay(new PingOverlayItem([](const PingMarks::Place &place, const QwtScaleMap &x, const QwtScaleMap &y) {
          const QPointF above = fromAbove(place);
          return QPointF(x.transform(above.x()), y.transform(above.y()));
      }))
{
    m_raster->attach(this);
    m_grid->attach(this);
    m_overlay->attach(this);
    for (const QwtAxisId axis : {QwtAxis::XBottom, QwtAxis::YLeft})
        setAxisVisible(axis, false);
    canvas()->setMouseTracking(true);
    canvas()->setCursor(Qt::CrossCursor);
    setAccessibleName(tr("%1, from above").arg(view.accessibleName()));
    connect(&view, &WaterfallView::rangeChanged, this, &PolarView::followColours);
    connect(&view.display(), &PictureDisplay::coloursChanged, this, &PolarView::followColours);
    connect(&view, &WaterfallView::thresholdChanged, this, &PolarView::followColours);
    connect(&view.display(), &PictureDisplay::layersChanged, this, &PolarView::followColours);
    connect(view.viewport(), &Viewport::spanChanged, this, &PolarView::followSpan);
    restyle();
}

PolarView::~PolarView() = default;

void PolarView::followPicture()
{
    m_raster->setPicture(m_view.picture(), m_view.frequencyAxis());
    if (m_view.picture())
        m_grid->unit = labelText(m_view.picture()->time().unit, mostUnitLetters);
    restyle();
}

void PolarView::restyle()
{
    QwtText heading = m_view.title();
    heading.setText(m_view.heading()); // the view itself may be narrow
    setTitle(heading);
    Theme::style(*this);
    m_overlay->colours = Theme::colours(*this);
    m_raster->setGround(palette().color(QPalette::Window));
    setCanvasBackground(palette().color(QPalette::Window));
    followColours();
    followSpan();
}

void PolarView::followColours()
{
    const PictureDisplay &display = m_view.display();
    m_raster->setColours(m_view.colours());
    m_overlay->hasTracks = display.shows(PictureDisplay::TrackLayer);
    m_overlay->hasTruth = display.shows(PictureDisplay::TruthLayer);
    m_overlay->hasEvents = display.shows(PictureDisplay::EventLayer);
    replot();
}

void PolarView::followSpan()
{
    const QSize size = canvas()->contentsRect().size();
    const Viewport *viewport = m_view.viewport();
    if (!viewport || viewport->isEmpty() || size.isEmpty())
        return;
    m_grid->longest = viewport->full().time.high;
    m_grid->nearest = viewport->full().time.low;
    // The same scale on both axes, for any shape of the canvas.
    const QRectF box = boundsOf(viewport->time(), viewport->frequency());
    const double perPixel = 1.02 * std::max(box.width() / size.width(), box.height() / size.height());
    const double x = 0.5 * perPixel * size.width();
    const double y = 0.5 * perPixel * size.height();
    setAxisScale(QwtAxis::XBottom, box.center().x() - x, box.center().x() + x);
    setAxisScale(QwtAxis::YLeft, box.center().y() - y, box.center().y() + y);
    updateAxes();
    replot();
}

PingMarks::Place PolarView::placeAt(const QPointF &position) const
{
    const double east = invTransform(QwtAxis::XBottom, position.x());
    const double north = invTransform(QwtAxis::YLeft, position.y());
    const double low = m_view.frequencyAxis().value(-0.5);
    double bearing = std::atan2(east, north) / degree;
    bearing -= 360.0 * std::floor((bearing - low) / 360.0);
    return {std::hypot(east, north), bearing};
}

QPointF PolarView::positionOf(const PingMarks::Place &place) const
{
    const QPointF above = fromAbove(place);
    return {transform(QwtAxis::XBottom, above.x()), transform(QwtAxis::YLeft, above.y())};
}

bool PolarView::eventFilter(QObject *watched, QEvent *event)
{
    Viewport *viewport = m_view.viewport();
    if (watched != canvas() || !m_view.picture() || !viewport)
        return ThemedPlot::eventFilter(watched, event);
    if (event->type() == QEvent::Leave)
        emit hoverEnded();
    if (event->type() == QEvent::MouseMove) {
        const PingMarks::Place place = placeAt(static_cast<QMouseEvent *>(event)->position());
        m_view.valueAt(place.along, place.across) ? emit hovered(place.along, place.across) : emit hoverEnded();
    }
    if (event->type() == QEvent::MouseButtonPress && static_cast<QMouseEvent *>(event)->button() == Qt::LeftButton) {
        setFocus(Qt::MouseFocusReason);
        const PingMarks::Place place = placeAt(static_cast<QMouseEvent *>(event)->position());
        if (m_view.valueAt(place.along, place.across))
            viewport->setCursor({place.along, place.across});
        return true;
    }
    return ThemedPlot::eventFilter(watched, event);
}

void PolarView::wheelEvent(QWheelEvent *event)
{
    Viewport *viewport = m_view.viewport();
    if (!viewport || viewport->isEmpty() || !event->modifiers().testFlag(Qt::ControlModifier))
        return event->ignore();
    const PingMarks::Place place = placeAt(canvas()->mapFrom(this, event->position()));
    viewport->zoomAt(std::pow(1.25, event->angleDelta().y() / 120.0), {place.along, place.across});
    event->accept();
}

void PolarView::keyPressEvent(QKeyEvent *event)
{
    QCoreApplication::sendEvent(&m_view, event);
}

void PolarView::contextMenuEvent(QContextMenuEvent *event)
{
    QMenu menu(this);
    addCommands(menu, m_view);
    const PingMarks::Place place = placeAt(canvas()->mapFrom(this, event->pos()));
    emit m_view.contextMenuRequested(&menu, place.along, place.across);
    menu.exec(event->globalPos());
}

} // namespace faintline
