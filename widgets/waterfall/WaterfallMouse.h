#pragma once

#include "widgets/base/Viewport.h"

#include <QObject>
#include <QPointF>

class QMouseEvent;
class QWheelEvent;

namespace faintline {

class MarkedWaterfall;

/// The mouse on a MarkedWaterfall. The action is chosen when a button is pressed:
///
///     middle              pan
///     left with Shift     a box to zoom to
///     left on a sideband  their spacing
///     left, measuring     the measured box
///     left                a click that places the cursor or, once moved, a pan
///
/// A double-click activates an event. The wheel scrolls time, with Shift frequency; with Ctrl it zooms about the
/// pointer, over an axis along that axis. With Ctrl every point snaps to the strongest cell nearby.
class WaterfallMouse : public QObject
{
    Q_OBJECT

public:
    /// `view` must outlive this.
    explicit WaterfallMouse(MarkedWaterfall &view);

    void turnWheel(const QWheelEvent &event);

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    enum class Drag { None, Press, Pan, Zoom, Measure, Sideband };

    void press(const QMouseEvent &event);
    void move(const QMouseEvent &event);
    void release(const QMouseEvent &event);
    void hover(const QPointF &position);
    void pan(const QPointF &position);
    void dragSideband(const QMouseEvent &event);
    int sidebandAt(const QPointF &position) const;
    Viewport::Point pointOf(const QMouseEvent &event) const;
    Viewport::Box draggedBox(const Viewport::Point &to) const;
    void scroll(Qt::Orientation direction, double notches);

    MarkedWaterfall &m_view;
    Drag m_drag = Drag::None;
    QPointF m_start;          ///< of the drag, canvas pixels
    Viewport::Box m_visible;  ///< visible box when it began
    Viewport::Point m_origin; ///< of a box
    int m_order = 0;          ///< of the sideband
};

} // namespace faintline
