#include "widgets/pings/PingViewports.h"

#include <QScopedValueRollback>

#include <algorithm>

namespace faintline {

PingViewports::PingViewports(Viewport &alongTime, QObject *parent) : QObject(parent), m_alongTime(alongTime)
{
    for (Viewport *viewport : {&m_alongTime, &m_map, &m_acrossTime}) {
        connect(viewport, &Viewport::spanChanged, this, [this, viewport] { followSpans(*viewport); });
        connect(viewport, &Viewport::cursorChanged, this, [this, viewport] { followCursor(*viewport); });
    }
}

void PingViewports::setExtents(const Extent &time, std::vector<Extent> axes)
{
    m_time = time;
    m_axes = std::move(axes);
    const bool isOther = m_plane != FramePlane();
    m_plane = {};
    m_place.position.resize(m_axes.size());
    showAxes();
    if (isOther)
        emit planeChanged();
}

void PingViewports::showAxes()
{
    const QScopedValueRollback following(m_isFollowing, true);
    const Extent &along = m_axes[m_plane.along];
    const Extent &across = m_axes[m_plane.across];
    m_map.setExtents(along.whole, across.whole, along.smallest, across.smallest);
    m_acrossTime.setExtents(m_time.whole, across.whole, m_time.smallest, across.smallest);
    m_alongTime.setExtents(m_time.whole, along.whole, m_time.smallest, along.smallest);
}

void PingViewports::setPlane(const FramePlane &plane)
{
    if (plane == m_plane)
        return;
    const bool areOthers = plane.along != m_plane.along || plane.across != m_plane.across;
    const bool isOpen = !m_map.isEmpty() && !m_alongTime.isEmpty();
    m_plane = plane;
    if (areOthers && isOpen && std::max(plane.along, plane.across) < m_axes.size()) {
        const Span time = m_alongTime.time();
        showAxes();
        if (time != m_time.whole)
            m_alongTime.zoomTo(time, m_alongTime.frequency());
        placeCursors();
    }
    emit planeChanged();
}

void PingViewports::setPlace(const Place &place)
{
    const bool isOther = !(place == m_place);
    m_place = place;
    placeCursors();
    if (isOther)
        emit placeChanged();
}

void PingViewports::placeCursors()
{
    const QScopedValueRollback following(m_isFollowing, true);
    m_alongTime.setCursor({m_place.seconds, along()});
    m_map.setCursor({along(), across()});
    m_acrossTime.setCursor({m_place.seconds, across()});
}

void PingViewports::followSpans(Viewport &from)
{
    // A viewport without extents belongs to a source that is no longer open.
    if (m_isFollowing || m_map.isEmpty() || m_alongTime.isEmpty())
        return;
    const QScopedValueRollback following(m_isFollowing, true);
    const Span time = &from == &m_acrossTime ? m_acrossTime.time() : m_alongTime.time();
    const Span along = &from == &m_alongTime ? m_alongTime.frequency() : m_map.time();
    const Span across = &from == &m_acrossTime ? m_acrossTime.frequency() : m_map.frequency();
    m_map.stretch(along, across);
    m_alongTime.stretch(time, along);
    m_acrossTime.stretch(time, across);
}

void PingViewports::followCursor(Viewport &from)
{
    if (m_isFollowing || !from.cursor() || std::max(m_plane.along, m_plane.across) >= m_place.position.size())
        return;
    const Viewport::Point &point = *from.cursor();
    Place place = m_place;
    if (&from == &m_map) {
        place.position[m_plane.along] = point.seconds;
        place.position[m_plane.across] = point.hz;
    } else {
        place.seconds = point.seconds;
        place.position[&from == &m_alongTime ? m_plane.along : m_plane.across] = point.hz;
    }
    setPlace(place);
    emit cursorMoved();
}

} // namespace faintline
