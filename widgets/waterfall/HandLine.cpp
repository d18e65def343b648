#include "widgets/waterfall/HandLine.h"

#include "widgets/base/Theme.h"

#include <QMouseEvent>
#include <QPainter>

#include <qwt_plot_item.h>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double reach = 9.0; ///< pixels within which a vertex can be grabbed
    constexpr double handleRadius = 4.5;

    bool isOfMouse(const QEvent &event)
    {
        switch (event.type()) {
        case QEvent::MouseButtonPress:
        case QEvent::MouseButtonDblClick:
        case QEvent::MouseMove:
        case QEvent::MouseButtonRelease:
        case QEvent::ContextMenu:
            return true;
        default:
            return false;
        }
    }

} // namespace

/// Draws the line with a dark outline, so that it is visible on any colour of the map.
class HandLine::Item : public QwtPlotItem
{
public:
    explicit Item(const HandLine &line) : m_line(line) { setZ(90.0); }

    void draw(QPainter *painter, const QwtScaleMap &, const QwtScaleMap &, const QRectF &) const override
    {
        QPolygonF polygon;
        for (const Viewport::Point &point : m_line.m_points)
            polygon.append(m_line.m_view.positionOf(point));
        painter->save();
        painter->setRenderHint(QPainter::Antialiasing);
        const QColor colour = Theme::colours(m_line.m_view).selectedEvent;
        for (const QPen &pen : {QPen(QColor(0, 0, 0, 190), 5.0), QPen(colour, 2.5)}) {
            painter->setPen(pen);
            painter->drawPolyline(polygon);
        }
        painter->setPen(QPen(QColor(0, 0, 0, 220), 1.5));
        painter->setBrush(colour);
        for (const QPointF &vertex : m_line.m_isActive || polygon.size() == 1 ? polygon : QPolygonF())
            painter->drawEllipse(vertex, handleRadius, handleRadius);
        painter->restore();
    }

private:
    const HandLine &m_line;
};

HandLine::HandLine(WaterfallView &view) : QObject(&view), m_view(view)
{
    (new Item(*this))->attach(&view); // owned by the plot
    view.canvas()->installEventFilter(this);
}

void HandLine::setActive(bool isActive, bool extends)
{
    m_extends = extends;
    if (m_isActive == isActive)
        return;
    m_isActive = isActive;
    m_held = -1;
    m_view.canvas()->setCursor(isActive ? Qt::PointingHandCursor : Qt::CrossCursor);
    m_view.replot();
}

void HandLine::setPoints(std::vector<Viewport::Point> points)
{
    std::stable_sort(points.begin(), points.end(), [](const auto &a, const auto &b) { return a.seconds < b.seconds; });
    m_points = std::move(points);
    m_held = -1;
    m_last = int(m_points.size()) - 1;
    update();
}

void HandLine::add(const Viewport::Point &point)
{
    m_last = insert(point);
    update();
}

void HandLine::removeLast()
{
    if (m_last < 0)
        return;
    m_points.erase(m_points.begin() + m_last);
    m_last = int(m_points.size()) - 1;
    update();
}

/// A new vertex at the time of an existing one replaces it.
int HandLine::insert(const Viewport::Point &point)
{
    const auto at = std::lower_bound(m_points.begin(), m_points.end(), point,
                                     [](const auto &a, const auto &b) { return a.seconds < b.seconds; });
    const auto place = at - m_points.begin();
    if (at != m_points.end() && at->seconds == point.seconds)
        *at = point;
    else
        m_points.insert(at, point);
    return int(place);
}

int HandLine::vertexAt(const QPointF &position) const
{
    int nearest = -1;
    double least = reach;
    for (std::size_t i = 0; i < m_points.size(); ++i) {
        const QPointF way = m_view.positionOf(m_points[i]) - position;
        if (const double distance = std::hypot(way.x(), way.y()); distance <= least) {
            least = distance;
            nearest = int(i);
        }
    }
    return nearest;
}

bool HandLine::isOnLine(const QPointF &position) const
{
    for (std::size_t i = 1; i < m_points.size(); ++i) {
        const QPointF from = m_view.positionOf(m_points[i - 1]);
        const QPointF way = m_view.positionOf(m_points[i]) - from;
        const double length = QPointF::dotProduct(way, way);
        const double share =
            length > 0.0 ? std::clamp(QPointF::dotProduct(position - from, way) / length, 0.0, 1.0) : 0.0;
        const QPointF off = position - from - share * way;
        if (std::hypot(off.x(), off.y()) <= reach)
            return true;
    }
    return false;
}

void HandLine::move(const QPointF &position)
{
    Viewport::Point point = m_view.pointAt(position);
    const Viewport::Box &full = m_view.viewport()->full();
    point.seconds = std::clamp(point.seconds, full.time.low, full.time.high);
    point.hz = std::clamp(point.hz, full.frequency.low, full.frequency.high);
    m_points.erase(m_points.begin() + m_held);
    m_held = m_last = insert(point);
    update();
}

void HandLine::update()
{
    m_view.replot();
    emit changed();
}

bool HandLine::eventFilter(QObject *watched, QEvent *event)
{
    // The canvas also sends events while the view is being destroyed, when the view must not be called.
    if (!m_isActive || !isOfMouse(*event) || !m_view.viewport() || !m_view.picture())
        return QObject::eventFilter(watched, event);
    const auto mouse = [event] { return static_cast<QMouseEvent *>(event); };
    switch (event->type()) {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
        if (mouse()->button() == Qt::RightButton) {
            m_last = vertexAt(mouse()->position());
            if (m_last >= 0) {
                removeLast();
                emit edited();
                return true;
            }
            return m_extends;
        }
        if (mouse()->button() != Qt::LeftButton)
            break;
        m_held = vertexAt(mouse()->position());
        if (m_held < 0 && !m_extends && !isOnLine(mouse()->position()))
            break;
        m_view.setFocus(Qt::MouseFocusReason);
        if (m_held < 0)
            m_held = insert(m_view.pointAt(mouse()->position()));
        move(mouse()->position());
        return true;
    case QEvent::MouseMove:
        if (m_held < 0)
            break;
        move(mouse()->position());
        return true;
    case QEvent::MouseButtonRelease:
        if (m_held < 0)
            break;
        m_held = -1;
        emit edited();
        return true;
    case QEvent::ContextMenu:
        return true; // the right button removes vertices
    default:
        break;
    }
    return QObject::eventFilter(watched, event);
}

} // namespace faintline
