#include "widgets/base/Viewport.h"

#include <cmath>

namespace faintline {

namespace {

    constexpr std::size_t historyLimit = 64;
    constexpr double lowestShare = 1e-3; ///< of the highest frequency, on a logarithmic scale

    Span scaled(const Span &span, double factor, double about)
    {
        return {about - (about - span.low) / factor, about + (span.high - about) / factor};
    }

    Span shifted(const Span &span, double by)
    {
        return {span.low + by, span.high + by};
    }

    /// `span` moved or widened by as little as possible to contain `wanted`.
    Span holding(const Span &span, const Span &wanted)
    {
        if (wanted.width() > span.width())
            return wanted;
        if (wanted.low < span.low)
            return shifted(span, wanted.low - span.low);
        if (wanted.high > span.high)
            return shifted(span, wanted.high - span.high);
        return span;
    }

    Span withRoom(const Span &span, const Span &visible)
    {
        const double room = 0.1 * std::max(span.width(), 0.5 * visible.width());
        return {span.low - room, span.high + room};
    }

} // namespace

Viewport::Viewport(QObject *parent) : QObject(parent) {}

void Viewport::setExtents(const Span &time, const Span &frequency, double smallestSeconds, double smallestHz)
{
    m_frequencies = frequency;
    m_full = m_visible = {time, frequency};
    m_smallest = {{0.0, std::min(smallestSeconds, time.width())}, {0.0, std::min(smallestHz, frequency.width())}};
    m_history.clear();
    m_isZoomRun = m_isGrowing = m_isFollowing = false;
    const bool wasLogarithmic = m_isLogarithmic;
    applyScale();
    emit extentsChanged();
    if (m_isLogarithmic != wasLogarithmic)
        emit scaleChanged();
    emit spanChanged();
    clearCursor();
    clearSelection();
}

bool Viewport::canBeLogarithmic() const
{
    return m_frequencies.high > 0.0 && m_frequencies.low > -0.01 * m_frequencies.high; // half a cell below 0 Hz is DC
}

void Viewport::setLogarithmic(bool isLogarithmic)
{
    if (!isEmpty() && !canBeLogarithmic())
        return;
    m_wantsLogarithmic = isLogarithmic;
    if ((isLogarithmic && canBeLogarithmic()) == m_isLogarithmic)
        return;
    applyScale();
    m_history.clear();
    m_isZoomRun = false;
    emit scaleChanged();
    emit spanChanged();
}

void Viewport::setOriginHz(double hz)
{
    if (hz == m_originHz)
        return;
    m_originHz = hz;
    emit scaleChanged();
}

/// What is visible stays, as far as the scale has it.
void Viewport::applyScale()
{
    const bool wasAll = showsAll();
    m_isLogarithmic = m_wantsLogarithmic && canBeLogarithmic();
    m_full.frequency = m_frequencies;
    if (m_isLogarithmic)
        m_full.frequency.low = std::max(std::abs(m_frequencies.low), lowestShare * m_frequencies.high);
    m_visible = wasAll ? m_full : clamped(m_visible);
}

double Viewport::onScale(double hz) const
{
    return m_isLogarithmic ? std::log(std::max(hz, lowestShare * m_full.frequency.low)) : hz;
}

Span Viewport::onScale(const Span &hz) const
{
    return {onScale(hz.low), onScale(hz.high)};
}

Span Viewport::fromScale(const Span &span) const
{
    return m_isLogarithmic ? Span{std::exp(span.low), std::exp(span.high)} : span;
}

/// The smallest span about the middle of another one.
double Viewport::smallestOnScale(const Span &span) const
{
    const double smallest = m_smallest.frequency.width();
    return m_isLogarithmic ? smallest / std::exp(span.middle()) : smallest;
}

Viewport::Box Viewport::clamped(const Box &box) const
{
    const Span full = onScale(m_full.frequency);
    const Span frequency = onScale(box.frequency);
    const Span within = frequency.within(full, smallestOnScale(frequency));
    Span hz = fromScale(within);
    if (within.low == full.low) // not a rounding error beside it
        hz.low = m_full.frequency.low;
    if (within.high == full.high)
        hz.high = m_full.frequency.high;
    return {box.time.within(m_full.time, m_smallest.time.width()), hz};
}

void Viewport::remember()
{
    m_history.push_back(m_visible);
    if (m_history.size() > historyLimit)
        m_history.erase(m_history.begin());
}

void Viewport::show(const Box &box)
{
    if (isEmpty() || m_visible == box)
        return;
    m_visible = box;
    if (m_isGrowing && m_isFollowing != isAtEnd()) {
        m_isFollowing = isAtEnd();
        emit followingChanged(m_isFollowing);
    }
    emit spanChanged();
}

bool Viewport::isAtEnd() const
{
    return m_visible.time.high >= m_full.time.high - 1e-3 * m_visible.time.width();
}

void Viewport::grow(const Span &time)
{
    m_isGrowing = true;
    m_full.time = time;
    if (m_isFollowing)
        show({shifted(m_visible.time, time.high - m_visible.time.high), m_visible.frequency});
}

void Viewport::setFollowing(bool isFollowing)
{
    if (isFollowing == m_isFollowing)
        return;
    m_isFollowing = isFollowing;
    m_isGrowing = true;
    if (isFollowing)
        show({shifted(m_visible.time, m_full.time.high - m_visible.time.high), m_visible.frequency});
    emit followingChanged(isFollowing);
}

void Viewport::zoomTo(const Span &time, const Span &frequency)
{
    const Box box = clamped({time, frequency});
    if (isEmpty() || box == m_visible)
        return;
    remember();
    m_isZoomRun = false;
    show(box);
}

void Viewport::zoomAt(double factor, const Point &point, Axes axes)
{
    if (isEmpty() || !(factor > 0.0))
        return;
    Box box = m_visible;
    if (axes != Axes::Frequency)
        box.time = scaled(box.time, std::min(factor, box.time.width() / std::max(m_smallest.time.width(), 1e-12)),
                          point.seconds);
    if (axes != Axes::Time) {
        const Span span = onScale(box.frequency);
        const double most = span.width() / std::max(smallestOnScale(span), 1e-12);
        box.frequency = fromScale(scaled(span, std::min(factor, most), onScale(point.hz)));
    }
    stretch(box.time, box.frequency);
}

void Viewport::stretch(const Span &time, const Span &frequency)
{
    const Box box = clamped({time, frequency});
    if (isEmpty() || box == m_visible)
        return;
    if (!m_isZoomRun)
        remember();
    m_isZoomRun = true;
    show(box);
}

void Viewport::pan(double seconds, double hz)
{
    const double low = m_visible.frequency.low;
    const double shift = m_isLogarithmic ? onScale(low + hz) - onScale(low) : hz;
    show(clamped({shifted(m_visible.time, seconds), fromScale(shifted(onScale(m_visible.frequency), shift))}));
}

void Viewport::scroll(double timeShare, double frequencyShare)
{
    const Span span = onScale(m_visible.frequency);
    show(clamped({shifted(m_visible.time, timeShare * m_visible.time.width()),
                  fromScale(shifted(span, frequencyShare * span.width()))}));
}

void Viewport::move(const Box &start, const Point &from, const Point &to)
{
    show(clamped({shifted(start.time, from.seconds - to.seconds),
                  fromScale(shifted(onScale(start.frequency), onScale(from.hz) - onScale(to.hz)))}));
}

void Viewport::reveal(const Box &box)
{
    const Span visible = onScale(m_visible.frequency);
    zoomTo(holding(m_visible.time, withRoom(box.time, m_visible.time)),
           fromScale(holding(visible, withRoom(onScale(box.frequency), visible))));
}

void Viewport::showAll()
{
    zoomTo(m_full.time, m_full.frequency);
}

void Viewport::zoomBack()
{
    if (m_history.empty())
        return;
    const Box box = m_history.back();
    m_history.pop_back();
    m_isZoomRun = false;
    show(box);
}

void Viewport::setCursor(const Point &point)
{
    if (isEmpty())
        return;
    const Point inside{std::clamp(point.seconds, m_full.time.low, m_full.time.high),
                       std::clamp(point.hz, m_full.frequency.low, m_full.frequency.high)};
    if (m_cursor == inside)
        return;
    m_cursor = inside;
    emit cursorChanged();
}

void Viewport::clearCursor()
{
    if (!m_cursor)
        return;
    m_cursor.reset();
    emit cursorChanged();
}

void Viewport::setSelection(const Box &box)
{
    if (m_selection == box)
        return;
    m_selection = box;
    emit selectionChanged();
}

void Viewport::clearSelection()
{
    if (!m_selection)
        return;
    m_selection.reset();
    emit selectionChanged();
}

} // namespace faintline
