#pragma once

#include "widgets/pings/TargetShape.h"

#include <QObject>
#include <QPointF>

#include <functional>

class QKeyEvent;
class QMouseEvent;
class QwtPlot;

namespace faintline {

class PolarView;
class WaterfallView;

/// Targets drawn over one map of a ping, with handles at their corners, and the mouse and keys that edit them. It
/// changes no target: it reports what the user does.
///
/// While active, a press on a handle grabs it. While placing as well, any other press places a target. All else still
/// goes to the view: without a handle under the pointer, clicks place the cursor and drags pan. Delete removes the
/// selected corner; Escape abandons a drag, or ends placing.
class TargetLayer : public QObject
{
    Q_OBJECT

public:
    using Place = PingMarks::Place;

    /// Range over bearing, or from above. The view must outlive this.
    explicit TargetLayer(WaterfallView &view);
    explicit TargetLayer(PolarView &view);

    void setShapes(const std::vector<TargetShape> &shapes);
    void setReach(const std::vector<Place> &outline); ///< drawn dotted; empty: none
    void setSelected(const TargetHandle &handle);
    void setActive(bool isActive);
    void setPlacing(bool isPlacing);

    /// The handle under a pixel of the canvas; the selected target's first.
    TargetHandle handleAt(const QPointF &position) const;

signals:
    /// A press on a handle or, while placing, elsewhere (no handle). `isShift`: with the Shift key.
    void pressed(const faintline::TargetHandle &handle, const faintline::PingMarks::Place &place, bool isShift);
    void dragged(const faintline::PingMarks::Place &place);
    void released();
    void abandoned(); ///< a drag, by Escape
    void removeRequested();
    void placingEnded();

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    class Item;

    TargetLayer(QwtPlot &plot, std::function<Place(const QPointF &)> placeAt,
                std::function<QPointF(const Place &)> positionOf, std::function<double()> turn);

    bool takesMouse(const QMouseEvent &event);
    bool press(const QMouseEvent &event);
    bool move(const QMouseEvent &event);
    bool release(const QMouseEvent &event);
    bool takesKey(const QKeyEvent &event) const;
    void pressKey(const QKeyEvent &event);

    QwtPlot &m_plot;
    std::function<Place(const QPointF &)> m_placeAt;
    std::function<QPointF(const Place &)> m_positionOf;
    std::function<double()> m_turn; ///< period of the bearing if lines across it are cut; 0: they are not
    std::vector<TargetShape> m_shapes;
    std::vector<Place> m_reach;
    TargetHandle m_selected;
    TargetHandle m_hovered;
    bool m_isActive = false;
    bool m_isPlacing = false;
    bool m_isPressed = false;
    bool m_isDragging = false;
    QPointF m_start; ///< of the press, canvas pixels
};

} // namespace faintline
