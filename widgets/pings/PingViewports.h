#pragma once

#include "base/FramePlane.h"
#include "widgets/base/Viewport.h"

#include <QObject>

#include <vector>

namespace faintline {

/// Three views of frames on several axes, of which two are shown: the map of these two, and each of them over time.
/// They share their axes: zooming or moving the cursor in one affects all. In each `Viewport` the first axis takes the
/// place of time, the second that of frequency.
class PingViewports : public QObject
{
    Q_OBJECT

public:
    /// A position in one frame.
    struct Place {
        double seconds = 0.0;
        std::vector<double> position; ///< one per axis of the grid, in its unit
        bool operator==(const Place &) const = default;
    };

    /// All of an axis, and the smallest span that limits zooming in, as in a Viewport.
    struct Extent {
        Span whole;
        double smallest = 0.0;
    };

    /// `alongTime`: time × the plane's axis `along`, shared with other views; not owned.
    explicit PingViewports(Viewport &alongTime, QObject *parent = nullptr);

    Viewport &map() { return m_map; } ///< along × across
    Viewport &alongTime() { return m_alongTime; }
    Viewport &acrossTime() { return m_acrossTime; }
    const Viewport &map() const { return m_map; }
    const Viewport &alongTime() const { return m_alongTime; }
    const Viewport &acrossTime() const { return m_acrossTime; }

    /// Sets the extents of another recording and shows all of it, on its first two axes.
    void setExtents(const Extent &time, std::vector<Extent> axes);

    /// The axes shown, and the cuts of the others.
    const FramePlane &plane() const { return m_plane; }
    /// Other axes are shown whole; the time shown remains.
    void setPlane(const FramePlane &plane);

    const Place &place() const { return m_place; }
    void setPlace(const Place &place);
    /// The place on the axes shown; 0 before there is one.
    double along() const { return on(m_plane.along); }
    double across() const { return on(m_plane.across); }

signals:
    void placeChanged();
    void cursorMoved(); ///< in one of the views, after `placeChanged`
    void planeChanged();

private:
    double on(std::size_t axis) const { return axis < m_place.position.size() ? m_place.position[axis] : 0.0; }
    void showAxes();
    void followSpans(Viewport &from);
    void followCursor(Viewport &from);
    void placeCursors();

    Viewport &m_alongTime;
    Viewport m_map;
    Viewport m_acrossTime;
    Extent m_time;
    std::vector<Extent> m_axes;
    FramePlane m_plane;
    Place m_place;
    bool m_isFollowing = false;
};

} // namespace faintline
