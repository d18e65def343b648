#include "live/SourceClock.h"

#include <cmath>
#include <cstdio>
#include <utility>

namespace faintline {

namespace {

    constexpr double intervalSeconds = 10.0;
    constexpr double leastSeconds = 0.1; ///< smallest departure reported

} // namespace

void SourceClock::restart()
{
    m_first.reset();
    m_current.reset();
    m_worthTelling = leastSeconds;
}

std::optional<SourceClock::Departure> SourceClock::note(Index counted, double seconds)
{
    const double late = seconds - double(counted) / m_rate;
    if (!m_current)
        m_current = {seconds, late, seconds};
    if (late < m_current->leastLate) {
        m_current->leastLate = late;
        m_current->at = seconds;
    }
    if (seconds - m_current->begin < intervalSeconds)
        return {};
    const Interval complete = *std::exchange(m_current, std::nullopt);
    if (m_first)
        return departureIn(complete);
    m_first = complete;
    return {};
}

std::optional<SourceClock::Departure> SourceClock::departureIn(const Interval &interval)
{
    const double behind = interval.leastLate - m_first->leastLate;
    if (std::abs(behind) < m_worthTelling)
        return {};
    while (m_worthTelling <= std::abs(behind))
        m_worthTelling *= 2.0;
    const double elapsed = interval.at - m_first->at;
    Departure departure{Index(std::llround(behind * m_rate)), 1e6 * behind / elapsed, {}};
    char words[200];
    std::snprintf(
        words, sizeof words,
        "The source's clock is %.3g ppm %s: in %.4g s it has got %.3g s %s this machine's; times are the source's.",
        std::abs(departure.ppm), behind > 0.0 ? "slow" : "fast", elapsed, std::abs(behind),
        behind > 0.0 ? "behind" : "ahead of");
    departure.words = words;
    return departure;
}

} // namespace faintline
