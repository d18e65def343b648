#include "widgets/waterfall/OverviewStrip.h"

#include "widgets/base/Theme.h"
#include "widgets/base/quantities.h"
#include "widgets/base/rasterise.h"
#include "widgets/base/scaleTicks.h"
#include "widgets/waterfall/RasterItem.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QFontMetricsF>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double sideMargin = 8.0;
    constexpr double tickHeight = 16.0;
    constexpr double edgeReach = 6.0;

} // namespace

OverviewStrip::OverviewStrip(QWidget *parent) : QWidget(parent), m_map(&ColourMap::named(ColourMap::defaultName()))
{
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setAccessibleName(tr("Overview of the recording"));
    setToolTip(tr("Drag the box to scroll or its sides to zoom. Double-click to show all."));
}

void OverviewStrip::setViewport(Viewport *viewport)
{
    if (m_viewport)
        m_viewport->disconnect(this);
    m_viewport = viewport;
    if (viewport) {
        connect(viewport, &Viewport::extentsChanged, this, &OverviewStrip::renew);
        connect(viewport, &Viewport::spanChanged, this, [this] {
            setAccessibleDescription(
                tr("Visible: %1 to %2")
                    .arg(secondsText(m_viewport->time().low, 0.1), secondsText(m_viewport->time().high, 0.1)));
            update();
        });
    }
    renew();
}

void OverviewStrip::setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &frequency)
{
    if (picture && picture == m_picture && frequency == m_frequency)
        return;
    m_picture = std::move(picture);
    m_frequency = frequency;
    renew();
}

void OverviewStrip::setColourMap(const ColourMap &map)
{
    m_map = &map;
    renew();
}

void OverviewStrip::setEvents(const std::vector<Event> &events)
{
    m_events = events;
    update();
}

QRectF OverviewStrip::pictureRect() const
{
    return {sideMargin, 3.0, width() - 2.0 * sideMargin, height() - 3.0 - tickHeight};
}

double OverviewStrip::xOf(double seconds) const
{
    const QRectF rect = pictureRect();
    const Span &full = m_viewport->full().time;
    return rect.left() + (seconds - full.low) / full.width() * rect.width();
}

double OverviewStrip::secondsAt(double x) const
{
    const QRectF rect = pictureRect();
    const Span &full = m_viewport->full().time;
    return full.low + (x - rect.left()) / rect.width() * full.width();
}

QRectF OverviewStrip::boxRect() const
{
    const QRectF rect = pictureRect();
    const double left = xOf(m_viewport->time().low), right = xOf(m_viewport->time().high);
    // The box of a small part of a long recording must remain visible and draggable.
    const double thin = std::max(6.0 - (right - left), 0.0) / 2.0;
    return {left - thin, rect.top(), right - left + 2.0 * thin, rect.height()};
}

/// Marks the picture for rendering when it is visible, so that the caller need not wait.
void OverviewStrip::renew()
{
    m_isStale = true;
    update();
}

void OverviewStrip::render()
{
    m_isStale = false;
    m_image = {};
    const QRectF rect = pictureRect();
    if (m_picture && m_picture->frameCount() > 0 && rect.width() > 1.0 && rect.height() > 1.0) {
        const double ratio = devicePixelRatioF();
        const QSize size(int(std::lround(rect.width() * ratio)), int(std::lround(rect.height() * ratio)));
        Viewport::Box box = WaterfallView::extents(m_picture->time(), m_frequency);
        if (m_viewport && m_viewport->full().time.high < box.time.high)
            box.time = m_viewport->full().time; // the end is not known
        const double frames = double(m_picture->frameCount()) / size.width();
        const double cells = double(m_frequency.count) / size.height();
        RasterItem raster;
        raster.setPicture(m_picture, m_frequency);
        raster.setTimeVertical(false);
        raster.setColours({m_map, automaticRange(m_picture->scale(), countPixels(*m_picture, frames, cells))});
        m_image = raster.image(box.time, box.frequency, true, size);
    }
}

void OverviewStrip::paintEvent(QPaintEvent *)
{
    if (m_isStale)
        render();
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF rect = pictureRect();
    const Theme::Colours &colours = Theme::colours(*this);
    painter.fillRect(rect, colours.canvas);
    if (m_image.isNull() || !m_viewport || m_viewport->isEmpty()) {
        painter.setFont(Theme::font(12));
        painter.setPen(colours.faintText);
        painter.drawText(rect, Qt::AlignCenter, tr("The whole recording is shown here."));
    } else {
        painter.drawImage(rect, m_image);
        paintTicks(painter);
        paintBox(painter);
        paintEvents(painter);
    }
    painter.setPen(QPen(colours.frame, 1.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(rect.adjusted(-0.5, -0.5, 0.5, 0.5));
}

void OverviewStrip::paintTicks(QPainter &painter) const
{
    const QRectF rect = pictureRect();
    const Theme::Colours &colours = Theme::colours(*this);
    const bool isClock = m_viewport->full().time.high > clockFromSeconds;
    painter.setFont(Theme::plotFont());
    const QFontMetricsF metrics(painter.font());
    const QwtScaleDiv div = timeScaleDiv(m_viewport->full().time, std::max(int(rect.width() / 110.0), 1));
    const int decimals = decimalsFor(majorStep(div));
    for (const double seconds : div.ticks(QwtScaleDiv::MajorTick)) {
        const double x = std::round(xOf(seconds)) + 0.5;
        painter.setPen(QPen(colours.faintText, 1.0));
        painter.drawLine(QPointF(x, rect.bottom() + 1.0), QPointF(x, rect.bottom() + 4.0));
        const QString text = isClock ? clockText(seconds, decimals, true) : numberText(seconds, decimals) + tr(" s");
        QRectF box(0.0, rect.bottom() + 3.0, metrics.horizontalAdvance(text) + 1.0, tickHeight - 3.0);
        box.moveLeft(std::clamp(x - box.width() / 2.0, 1.0, std::max(width() - box.width() - 1.0, 1.0)));
        painter.drawText(box, Qt::AlignCenter, text);
    }
}

void OverviewStrip::paintEvents(QPainter &painter) const
{
    const QRectF rect = pictureRect();
    painter.setPen(QPen(QColor(0, 0, 0, 160), 1.0));
    painter.setBrush(Theme::colours(*this).event);
    for (const Event &event : m_events) {
        const double x = xOf(event.onsetSeconds);
        painter.drawPolygon(QPolygonF{{x, rect.bottom() - 6.0}, {x - 3.5, rect.bottom()}, {x + 3.5, rect.bottom()}});
    }
}

void OverviewStrip::paintBox(QPainter &painter) const
{
    const QRectF rect = pictureRect();
    const QRectF box = boxRect();
    const bool isAll = m_viewport->showsAll();
    if (!isAll) {
        QPainterPath outside;
        outside.setFillRule(Qt::OddEvenFill);
        outside.addRect(rect);
        outside.addRect(box);
        painter.fillPath(outside, QColor(0, 0, 0, 130));
    }
    const QColor colour = hasFocus() || !isAll ? QColor(Qt::white) : QColor(255, 255, 255, 140);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(0, 0, 0, 160), 3.0));
    painter.drawRect(box.adjusted(1.0, 1.0, -1.0, -1.0));
    painter.setPen(QPen(colour, 1.4));
    painter.drawRect(box.adjusted(1.0, 1.0, -1.0, -1.0));
}

void OverviewStrip::resizeEvent(QResizeEvent *)
{
    renew();
}

OverviewStrip::Grip OverviewStrip::gripAt(const QPointF &position) const
{
    if (!m_viewport || m_viewport->isEmpty())
        return Grip::None;
    const QRectF box = boxRect();
    const double toLow = std::abs(position.x() - box.left()), toHigh = std::abs(position.x() - box.right());
    if (std::min(toLow, toHigh) <= edgeReach)
        return toLow < toHigh ? Grip::Low : Grip::High;
    return position.x() > box.left() && position.x() < box.right() ? Grip::Box : Grip::None;
}

void OverviewStrip::mousePressEvent(QMouseEvent *event)
{
    if (event->button() != Qt::LeftButton || !m_viewport || m_viewport->isEmpty())
        return;
    m_grip = gripAt(event->position());
    const double seconds = secondsAt(event->position().x());
    if (m_grip == Grip::None) { // move there and continue dragging
        m_viewport->pan(seconds - m_viewport->time().middle(), 0.0);
        m_grip = Grip::Box;
    }
    m_gripSeconds = seconds;
    m_gripSpan = m_viewport->time();
}

void OverviewStrip::mouseMoveEvent(QMouseEvent *event)
{
    if (m_grip == Grip::None) {
        const Grip grip = gripAt(event->position());
        setCursor(grip == Grip::Low || grip == Grip::High ? Qt::SizeHorCursor
                  : grip == Grip::Box                     ? Qt::OpenHandCursor
                                                          : Qt::ArrowCursor);
        return;
    }
    const double shift = secondsAt(event->position().x()) - m_gripSeconds;
    if (m_grip == Grip::Box) {
        m_viewport->pan(m_gripSpan.low + shift - m_viewport->time().low, 0.0);
        return;
    }
    Span span = m_gripSpan;
    (m_grip == Grip::Low ? span.low : span.high) += shift;
    if (span.low > span.high)
        std::swap(span.low, span.high);
    m_viewport->stretch(span, m_viewport->frequency());
}

void OverviewStrip::mouseReleaseEvent(QMouseEvent *)
{
    m_grip = Grip::None;
}

void OverviewStrip::mouseDoubleClickEvent(QMouseEvent *)
{
    m_grip = Grip::None;
    if (m_viewport)
        m_viewport->showAll();
}

void OverviewStrip::wheelEvent(QWheelEvent *event)
{
    if (m_viewport && !m_viewport->isEmpty())
        m_viewport->zoomAt(std::pow(1.25, event->angleDelta().y() / 120.0),
                           {secondsAt(event->position().x()), m_viewport->frequency().middle()}, Viewport::Axes::Time);
    event->accept();
}

void OverviewStrip::keyPressEvent(QKeyEvent *event)
{
    if (!m_viewport || m_viewport->isEmpty())
        return QWidget::keyPressEvent(event);
    const Span &time = m_viewport->time();
    const Viewport::Point middle{time.middle(), m_viewport->frequency().middle()};
    switch (event->key()) {
    case Qt::Key_Left:
        m_viewport->pan(-0.1 * time.width(), 0.0);
        return;
    case Qt::Key_Right:
        m_viewport->pan(0.1 * time.width(), 0.0);
        return;
    case Qt::Key_Home:
        m_viewport->pan(-m_viewport->full().time.width(), 0.0);
        return;
    case Qt::Key_End:
        m_viewport->pan(m_viewport->full().time.width(), 0.0);
        return;
    case Qt::Key_Plus:
        m_viewport->zoomAt(1.25, middle, Viewport::Axes::Time);
        return;
    case Qt::Key_Minus:
        m_viewport->zoomAt(0.8, middle, Viewport::Axes::Time);
        return;
    case Qt::Key_0:
        m_viewport->showAll();
        return;
    case Qt::Key_Backspace:
        m_viewport->zoomBack();
        return;
    default:
        QWidget::keyPressEvent(event);
    }
}

void OverviewStrip::changeEvent(QEvent *event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange)
        update();
}

} // namespace faintline
