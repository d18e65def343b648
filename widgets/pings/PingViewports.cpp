#include "widgets/pings/PingViewports.h"

#include <QScopedValueRollback>

namespace faintline {

PingViewports::PingViewports(Viewport &rangeTime, QObject *parent) : QObject(parent), m_rangeTime(rangeTime)
{
    for (Viewport *viewport : {&m_rangeTime, &m_map, &m_bearingTime}) {
        connect(viewport, &Viewport::spanChanged, this, [this, viewport] { followSpans(*viewport); });
        connect(viewport, &Viewport::cursorChanged, this, [this, viewport] { followCursor(*viewport); });
    }
}

void PingViewports::setExtents(const Span &time, const Span &range, const Span &bearing, const Place &smallest)
{
    const QScopedValueRollback following(m_isFollowing, true);
    m_map.setExtents(range, bearing, smallest.range, smallest.bearing);
    m_bearingTime.setExtents(time, bearing, smallest.seconds, smallest.bearing);
    m_rangeTime.setExtents(time, range, smallest.seconds, smallest.range);
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
    m_rangeTime.setCursor({m_place.seconds, m_place.range});
    m_map.setCursor({m_place.range, m_place.bearing});
    m_bearingTime.setCursor({m_place.seconds, m_place.bearing});
}

void PingViewports::followSpans(Viewport &from)
{
    // A viewport without extents belongs to a source that is no longer open.
    if (m_isFollowing || m_map.isEmpty() || m_rangeTime.isEmpty())
        return;
    const QScopedValueRollback following(m_isFollowing, true);
    const Span time = &from == &m_bearingTime ? m_bearingTime.time() : m_rangeTime.time();
    const Span range = &from == &m_rangeTime ? m_rangeTime.frequency() : m_map.time();
    const Span bearing = &from == &m_bearingTime ? m_bearingTime.frequency() : m_map.frequency();
    m_map.stretch(range, bearing);
    m_rangeTime.stretch(time, range);
    m_bearingTime.stretch(time, bearing);
}

void PingViewports::followCursor(Viewport &from)
{
    if (m_isFollowing || !from.cursor())
        return;
    const Viewport::Point &point = *from.cursor();
    Place place = m_place;
    if (&from == &m_map) {
        place.range = point.seconds;
        place.bearing = point.hz;
    } else {
        place.seconds = point.seconds;
        (&from == &m_rangeTime ? place.range : place.bearing) = point.hz;
    }
    setPlace(place);
}

} // namespace faintline
