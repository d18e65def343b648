#pragma once

#include "widgets/base/Viewport.h"

#include <QObject>

namespace faintline {

/// Three views of a sonar's pings on common range, bearing and time axes: zooming or moving the cursor in one affects
/// all. In each `Viewport` the first axis takes the place of time, the second that of frequency.
class PingViewports : public QObject
{
    Q_OBJECT

public:
    /// A position in one ping: seconds, and the units of the range and the bearing axis.
    struct Place {
        double seconds = 0.0;
        double range = 0.0;
        double bearing = 0.0;
        bool operator==(const Place &) const = default;
    };

    /// `rangeTime`: time × range, shared with other views; not owned.
    explicit PingViewports(Viewport &rangeTime, QObject *parent = nullptr);

    Viewport &map() { return m_map; } ///< range × bearing
    Viewport &rangeTime() { return m_rangeTime; }
    Viewport &bearingTime() { return m_bearingTime; }
    const Viewport &map() const { return m_map; }
    const Viewport &rangeTime() const { return m_rangeTime; }
    const Viewport &bearingTime() const { return m_bearingTime; }

    /// Sets the extents of another recording and shows all of it. The smallest spans limit zooming in, as in a
    /// Viewport.
    void setExtents(const Span &time, const Span &range, const Span &bearing, const Place &smallest);

    const Place &place() const { return m_place; }
    void setPlace(const Place &place);

signals:
    void placeChanged();

private:
    void followSpans(Viewport &from);
    void followCursor(Viewport &from);
    void placeCursors();

    Viewport &m_rangeTime;
    Viewport m_map;
    Viewport m_bearingTime;
    Place m_place;
    bool m_isFollowing = false;
};

} // namespace faintline
