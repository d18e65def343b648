#pragma once

#include "widgets/waterfall/WaterfallView.h"

#include <QObject>

#include <vector>

namespace faintline {

/// A polyline drawn by hand over a waterfall, with vertices in ascending time.
///
/// While active, a press beside the line adds a vertex and a press on a vertex grabs it; both follow the mouse until it
/// is released. A right-click on a vertex removes it. Wheel and keys still go to the view. Vertices are marked while they
/// can be grabbed.
class HandLine : public QObject
{
    Q_OBJECT

public:
    /// `view` must outlive this.
    explicit HandLine(WaterfallView &view);

    bool isActive() const { return m_isActive; }
    /// `extends`: a press anywhere adds a vertex, otherwise one on the line.
    void setActive(bool isActive, bool extends = true);

    const std::vector<Viewport::Point> &points() const { return m_points; }
    void setPoints(std::vector<Viewport::Point> points); ///< sorted by time
    void add(const Viewport::Point &point);
    void removeLast(); ///< the vertex that was changed last
    void clear() { setPoints({}); }

signals:
    void changed();
    void edited(); ///< with the mouse, when it is released

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    class Item;

    int vertexAt(const QPointF &position) const; ///< -1: none
    bool isOnLine(const QPointF &position) const;
    int insert(const Viewport::Point &point);
    void move(const QPointF &position);
    void update();

    WaterfallView &m_view;
    std::vector<Viewport::Point> m_points;
    bool m_isActive = false;
    bool m_extends = true;
    int m_held = -1;
    int m_last = -1;
};

} // namespace faintline
