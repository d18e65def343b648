#include "widgets/waterfall/WaterfallMouse.h"

#include "widgets/waterfall/MarkedWaterfall.h"

#include <qwt_scale_widget.h>

#include <QMouseEvent>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    constexpr double scrollShare = 0.1; ///< fraction of the visible part, per notch of the wheel
    constexpr double zoomPerNotch = 1.25;
    constexpr double clickSlop = 4.0;     ///< pixels that a click may move
    constexpr double sidebandReach = 5.0; ///< pixels

    double notchesOf(const QWheelEvent &event)
    {
        // Some platforms swap the wheel's direction while Shift or Alt is held.
        const QPoint delta = event.angleDelta();
        return (delta.y() != 0 ? delta.y() : delta.x()) / 120.0;
    }

} // namespace

WaterfallMouse::WaterfallMouse(MarkedWaterfall &view) : m_view(view)
{
    view.canvas()->setMouseTracking(true);
    view.canvas()->setCursor(Qt::CrossCursor);
    view.canvas()->installEventFilter(this);
}

bool WaterfallMouse::eventFilter(QObject *watched, QEvent *event)
{
    if (!m_view.picture() || !m_view.viewport())
        return QObject::eventFilter(watched, event);
    switch (event->type()) {
    case QEvent::MouseButtonPress:
        press(*static_cast<QMouseEvent *>(event));
        return true;
    case QEvent::MouseMove:
        move(*static_cast<QMouseEvent *>(event));
        return true;
    case QEvent::MouseButtonRelease:
        release(*static_cast<QMouseEvent *>(event));
        return true;
    case QEvent::MouseButtonDblClick:
        if (const int id = m_view.eventAt(static_cast<QMouseEvent *>(event)->position()))
            emit m_view.eventActivated(id);
        return true;
    case QEvent::Leave:
        m_view.setHoveredEvent(0);
        emit m_view.hoverEnded();
        break;
    default:
        break;
    }
    return QObject::eventFilter(watched, event);
}

void WaterfallMouse::press(const QMouseEvent &event)
{
    m_view.setFocus(Qt::MouseFocusReason);
    if (event.button() != Qt::LeftButton && event.button() != Qt::MiddleButton)
        return;
    m_start = event.position();
    m_visible = m_view.viewport()->visible();
    m_origin = m_view.pointAt(event.position());
    m_order = sidebandAt(event.position());
    m_drag = event.button() == Qt::MiddleButton              ? Drag::Pan
             : event.modifiers().testFlag(Qt::ShiftModifier) ? Drag::Zoom
             : m_order != 0                                  ? Drag::Sideband
             : m_view.display().isMeasuring()                ? Drag::Measure
                                                             : Drag::Press;
    if (m_drag == Drag::Measure)
        m_origin = pointOf(event);
}

void WaterfallMouse::move(const QMouseEvent &event)
{
    hover(event.position());
    if (m_drag == Drag::Press && (event.position() - m_start).manhattanLength() >= clickSlop) {
        m_drag = Drag::Pan;
        m_view.canvas()->setCursor(Qt::ClosedHandCursor);
    }
    switch (m_drag) {
    case Drag::None: {
        const auto across = m_view.isTimeVertical() ? Qt::SplitHCursor : Qt::SplitVCursor;
        m_view.canvas()->setCursor(sidebandAt(event.position()) != 0 ? across : Qt::CrossCursor);
        break;
    }
    case Drag::Press:
        break;
    case Drag::Pan:
        pan(event.position());
        break;
    case Drag::Zoom:
        m_view.setRubber(draggedBox(m_view.pointAt(event.position())));
        break;
    case Drag::Measure:
        m_view.viewport()->setSelection(draggedBox(pointOf(event)));
        break;
    case Drag::Sideband:
        dragSideband(event);
        break;
    }
}

void WaterfallMouse::release(const QMouseEvent &event)
{
    const Drag drag = std::exchange(m_drag, Drag::None);
    const bool isClick = (event.position() - m_start).manhattanLength() < clickSlop;
    m_view.canvas()->setCursor(Qt::CrossCursor);
    m_view.setRubber({});
    if (drag == Drag::Zoom && !isClick) {
        const Viewport::Box box = draggedBox(m_view.pointAt(event.position()));
        m_view.viewport()->zoomTo(box.time, box.frequency);
    } else if (drag == Drag::Press || (drag == Drag::Measure && isClick)) {
        m_view.viewport()->setCursor(pointOf(event));
    }
}

void WaterfallMouse::hover(const QPointF &position)
{
    m_view.setHoveredEvent(m_view.eventAt(position));
    const Viewport::Point point = m_view.pointAt(position);
    if (const auto value = m_view.valueAt(point.seconds, point.hz))
        emit m_view.hovered(point.seconds, point.hz, *value);
    else
        emit m_view.hoverEnded();
}

/// Keeps the point at which the drag began under the pointer.
void WaterfallMouse::pan(const QPointF &position)
{
    m_view.viewport()->move(m_visible, m_view.pointAt(m_start), m_view.pointAt(position));
}

void WaterfallMouse::dragSideband(const QMouseEvent &event)
{
    m_view.display().setSidebandSpacing(
        std::max(m_view.sidebands()->spacingFor(m_order, pointOf(event).hz), m_view.frequencyAxis().step));
}

/// The sideband whose line is under the pointer; 0 for none or the carrier.
int WaterfallMouse::sidebandAt(const QPointF &position) const
{
    const auto lines = m_view.sidebands();
    if (!lines)
        return 0;
    const int order = lines->nearestOrder(m_view.pointAt(position).hz);
    const QPointF line = m_view.positionOf({m_view.viewport()->cursor()->seconds, lines->hz(order)});
    return std::abs(m_view.isTimeVertical() ? line.x() - position.x() : line.y() - position.y()) <= sidebandReach
               ? order
               : 0;
}

/// Position of the pointer; with Ctrl, of the strongest cell near it.
Viewport::Point WaterfallMouse::pointOf(const QMouseEvent &event) const
{
    const Viewport::Point point = m_view.pointAt(event.position());
    return event.modifiers().testFlag(Qt::ControlModifier) ? m_view.peakAround(point).value_or(point) : point;
}

Viewport::Box WaterfallMouse::draggedBox(const Viewport::Point &to) const
{
    const Viewport::Box &full = m_view.viewport()->full();
    const auto spanOf = [](double p, double q, const Span &limits) {
        return Span{std::max(std::min(p, q), limits.low), std::min(std::max(p, q), limits.high)};
    };
    return {spanOf(m_origin.seconds, to.seconds, full.time), spanOf(m_origin.hz, to.hz, full.frequency)};
}

void WaterfallMouse::scroll(Qt::Orientation direction, double notches)
{
    const bool isTime = (direction == Qt::Vertical) == m_view.isTimeVertical();
    // Turning the wheel away from the user moves up or left; up is later with the newest on top, and higher in
    // frequency.
    const bool isNewestOnTop = m_view.direction().orientation() == MarkedWaterfall::Orientation::NewestOnTop;
    const bool isUpward = direction == Qt::Vertical && (!isTime || isNewestOnTop);
    const double share = notches * scrollShare * (isUpward ? 1.0 : -1.0);
    m_view.viewport()->scroll(isTime ? share : 0.0, isTime ? 0.0 : share);
}

void WaterfallMouse::turnWheel(const QWheelEvent &event)
{
    Viewport &viewport = *m_view.viewport();
    const Viewport::Point point = m_view.pointAt(m_view.canvas()->mapFrom(&m_view, event.position()));
    const double notches = notchesOf(event);
    const double factor = std::pow(zoomPerNotch, notches);
    const auto isOver = [&](QwtAxisId axis) {
        return m_view.isAxisVisible(axis) && m_view.axisWidget(axis)->geometry().contains(event.position().toPoint());
    };
    if (isOver(m_view.timeAxis()))
        viewport.zoomAt(factor, point, Viewport::Axes::Time);
    else if (isOver(m_view.hzAxis()))
        viewport.zoomAt(factor, point, Viewport::Axes::Frequency);
    else if (event.modifiers().testFlag(Qt::ControlModifier))
        viewport.zoomAt(factor, point);
    else if (event.modifiers().testFlag(Qt::ShiftModifier))
        scroll(m_view.isTimeVertical() ? Qt::Horizontal : Qt::Vertical, notches);
    else
        scroll(m_view.isTimeVertical() ? Qt::Vertical : Qt::Horizontal, notches);
}

} // namespace faintline
