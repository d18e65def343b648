#include "widgets/pings/TargetLayer.h"

#include "widgets/base/textPlate.h"
#include "widgets/pings/PolarView.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QKeyEvent>
#include <QLineF>
#include <QMouseEvent>
#include <QPainter>

#include <qwt_plot.h>
#include <qwt_plot_item.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    constexpr double reach = 9.0; ///< pixels within which a handle can be grabbed
    constexpr double slop = 4.0;  ///< pixels that a click may move
    constexpr double handleRadius = 4.5;
    constexpr double hoveredRadius = 6.5;
    const QColor outline(0, 0, 0, 190);

} // namespace

/// Paths as dashed lines, corners as discs and starts as squares with the target's number.
class TargetLayer::Item : public QwtPlotItem
{
public:
    explicit Item(const TargetLayer &layer) : m_layer(layer)
    {
        constexpr double aboveAllMarks = 90.0;
        setZ(aboveAllMarks);
    }

    void draw(QPainter *painter, const QwtScaleMap &, const QwtScaleMap &, const QRectF &rect) const override
    {
        if (!m_layer.m_isActive)
            return;
        painter->save();
        painter->setRenderHint(QPainter::Antialiasing);
        painter->setClipRect(rect);
        drawReach(*painter);
        for (int i = 0; i < int(m_layer.m_shapes.size()); ++i)
            if (i != m_layer.m_selected.target)
                drawTarget(*painter, i, rect);
        if (m_layer.m_selected.target >= 0 && m_layer.m_selected.target < int(m_layer.m_shapes.size()))
            drawTarget(*painter, m_layer.m_selected.target, rect); // above the others
        painter->restore();
    }

private:
    void drawTarget(QPainter &painter, int number, const QRectF &rect) const
    {
        const TargetShape &shape = m_layer.m_shapes[std::size_t(number)];
        const Theme::Colours &colours = Theme::colours(m_layer.m_plot);
        const QColor colour = number == m_layer.m_selected.target ? colours.event : colours.truth;
        drawPath(painter, shape.path, colour);
        for (int corner = int(shape.corners.size()) - 1; corner >= 0; --corner)
            drawHandle(painter, {number, corner}, colour);
        if (!shape.corners.empty())
            drawNumber(painter, m_layer.m_positionOf(shape.corners.front()), number, colour, rect);
    }

    void drawPath(QPainter &painter, const std::vector<Place> &path, const QColor &colour) const
    {
        const double turn = m_layer.m_turn();
        QPolygonF line;
        const auto draw = [&] {
            painter.setPen(QPen(outline, 3.5, Qt::SolidLine, Qt::FlatCap));
            painter.drawPolyline(line);
            painter.setPen(QPen(colour, 1.5, Qt::DashLine, Qt::FlatCap));
            painter.drawPolyline(line);
            line.clear();
        };
        for (std::size_t i = 0; i < path.size(); ++i) {
            if (i > 0 && turn > 0.0 && 2.0 * std::abs(path[i].across - path[i - 1].across) > turn)
                draw();
            line << m_layer.m_positionOf(path[i]);
        }
        draw();
    }

    void drawReach(QPainter &painter) const
    {
        for (const double turns : {-1.0, 0.0, 1.0}) { // what leaves one edge comes in at the other
            QPolygonF line;
            for (const Place &place : m_layer.m_reach)
                line << m_layer.m_positionOf({place.along, place.across + turns * m_layer.m_turn()});
            painter.setPen(QPen(outline, 3.5, Qt::SolidLine, Qt::FlatCap));
            painter.drawPolyline(line);
            painter.setPen(QPen(Theme::colours(m_layer.m_plot).event, 1.5, Qt::DotLine, Qt::FlatCap));
            painter.drawPolyline(line);
            if (m_layer.m_turn() == 0.0)
                break;
        }
    }

    void drawHandle(QPainter &painter, const TargetHandle &handle, const QColor &colour) const
    {
        const Place &place = m_layer.m_shapes[std::size_t(handle.target)].corners[std::size_t(handle.corner)];
        const QPointF at = m_layer.m_positionOf(place);
        const double radius = handle == m_layer.m_hovered ? hoveredRadius : handleRadius;
        painter.setPen(QPen(handle == m_layer.m_selected ? QColor(Qt::white) : outline, 2.0));
        painter.setBrush(colour);
        if (handle.corner == 0)
            painter.drawRect(QRectF(at - QPointF(radius, radius), QSizeF(2.0 * radius, 2.0 * radius)));
        else
            painter.drawEllipse(at, radius, radius);
        painter.setBrush(Qt::NoBrush);
    }

    void drawNumber(QPainter &painter, const QPointF &beside, int number, const QColor &colour,
                    const QRectF &rect) const
    {
        const QString text = QStringLiteral("T%1").arg(number + 1);
        painter.setFont(Theme::plotFont());
        drawOnPlate(painter, plateOf(text, beside + QPointF(8.0, 5.0), rect), text, colour, QColor(0, 0, 0, 165));
    }

    const TargetLayer &m_layer;
};

TargetLayer::TargetLayer(WaterfallView &view)
    : TargetLayer(
        view,
        [&view](const QPointF &position) {
            const Viewport::Point point = view.pointAt(position);
            return Place{point.seconds, point.hz};
        },
        [&view](const Place &place) {
            return view.positionOf({place.along, place.across});
        },
        [&view] {
            const Axis &bearing = view.frequencyAxis();
            return bearing.cyclic ? bearing.step * double(bearing.count) : 0.0;
        })
{
}

TargetLayer::TargetLayer(PolarView &view)
    : TargetLayer(
        view, [&view](const QPointF &position) { return view.placeAt(position); },
        [&view](const Place &place) { return view.positionOf(place); }, [] { return 0.0; })
{
}

TargetLayer::TargetLayer(QwtPlot &plot, std::function<Place(const QPointF &)> placeAt,
                         std::function<QPointF(const Place &)> positionOf, std::function<double()> turn)
    : QObject(&plot), m_plot(plot), m_placeAt(std::move(placeAt)), m_positionOf(std::move(positionOf)),
      m_turn(std::move(turn))
{
    (new Item(*this))->attach(&plot); // owned by the plot
    plot.installEventFilter(this);    // for keys
    plot.canvas()->installEventFilter(this);
}

void TargetLayer::setShapes(const std::vector<TargetShape> &shapes)
{
    m_shapes = shapes;
    if (m_isActive)
        m_plot.replot();
}

void TargetLayer::setReach(const std::vector<Place> &outline)
{
    m_reach = outline;
    if (m_isActive)
        m_plot.replot();
}

void TargetLayer::setSelected(const TargetHandle &handle)
{
    m_selected = handle;
    if (m_isActive)
        m_plot.replot();
}

void TargetLayer::setActive(bool isActive)
{
    if (isActive == m_isActive)
        return;
    m_isActive = isActive;
    m_isPressed = m_isDragging = false;
    m_hovered = {};
    m_plot.replot();
}

void TargetLayer::setPlacing(bool isPlacing)
{
    m_isPlacing = isPlacing;
}

TargetHandle TargetLayer::handleAt(const QPointF &position) const
{
    TargetHandle nearest;
    double least = reach;
    const auto look = [&](int target) {
        const std::vector<Place> &corners = m_shapes[std::size_t(target)].corners;
        for (int corner = int(corners.size()) - 1; corner >= 0; --corner)
            if (const double distance = QLineF(m_positionOf(corners[std::size_t(corner)]), position).length();
                distance < least) {
                least = distance;
                nearest = {target, corner};
            }
    };
    if (m_selected.target >= 0 && m_selected.target < int(m_shapes.size()))
        look(m_selected.target);
    if (nearest.isNone())
        for (int target = 0; target < int(m_shapes.size()); ++target)
            look(target);
    return nearest;
}

bool TargetLayer::press(const QMouseEvent &event)
{
    if (event.button() != Qt::LeftButton)
        return false;
    const TargetHandle handle = handleAt(event.position());
    if (handle.isNone() && !m_isPlacing)
        return false;
    m_plot.setFocus(Qt::MouseFocusReason);
    m_isPressed = true;
    m_isDragging = false;
    m_start = event.position();
    emit pressed(handle, m_placeAt(m_start), event.modifiers().testFlag(Qt::ShiftModifier));
    return true;
}

bool TargetLayer::move(const QMouseEvent &event)
{
    if (!m_isPressed) {
        if (const TargetHandle hovered = handleAt(event.position()); hovered != m_hovered) {
            m_hovered = hovered;
            m_plot.replot();
        }
        return false; // the view reads out what is there
    }
    m_isDragging = m_isDragging || (event.position() - m_start).manhattanLength() >= slop;
    if (m_isDragging)
        emit dragged(m_placeAt(event.position()));
    return true;
}

bool TargetLayer::release(const QMouseEvent &event)
{
    if (!m_isPressed || event.button() != Qt::LeftButton)
        return m_isPressed;
    m_isPressed = m_isDragging = false;
    emit released();
    return true;
}

bool TargetLayer::takesMouse(const QMouseEvent &event)
{
    switch (event.type()) {
    case QEvent::MouseMove:
        return move(event);
    case QEvent::MouseButtonRelease:
        return release(event);
    default:
        return press(event);
    }
}

bool TargetLayer::takesKey(const QKeyEvent &event) const
{
    return (event.key() == Qt::Key_Delete && !m_selected.isNone())
           || (event.key() == Qt::Key_Escape && (m_isPlacing || m_isPressed));
}

void TargetLayer::pressKey(const QKeyEvent &event)
{
    if (event.key() == Qt::Key_Delete)
        emit removeRequested();
    else if (std::exchange(m_isPressed, false))
        emit abandoned();
    else
        emit placingEnded();
}

bool TargetLayer::eventFilter(QObject *watched, QEvent *event)
{
    // The canvas also sends events while the view is being destroyed, when the view must not be called.
    const bool isOfPlot = watched == &m_plot;
    switch (event->type()) {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
    case QEvent::MouseMove:
    case QEvent::MouseButtonRelease:
        return m_isActive && !isOfPlot && takesMouse(*static_cast<QMouseEvent *>(event));
    case QEvent::KeyPress:
    case QEvent::ShortcutOverride:
        break;
    default:
        return false;
    }
    const auto &key = *static_cast<QKeyEvent *>(event);
    if (!m_isActive || !isOfPlot || !takesKey(key))
        return false;
    if (event->type() == QEvent::KeyPress)
        pressKey(key);
    event->accept(); // also before the shortcut of the same key, Stop's
    return true;
}

} // namespace faintline
