#include "signal/FrequencyCurve.h"

#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace faintline {

FrequencyCurve::FrequencyCurve(const Axis &time, std::vector<double> hz)
    : m_time(time), m_hz(std::move(hz)), m_cycles(m_hz.size())
{
    if (m_hz.empty() || std::ssize(m_hz) != m_time.count)
        throw Error("frequency curve", "needs one frequency for each of at least one time");
    if (!std::all_of(m_hz.begin(), m_hz.end(), [](double value) { return std::isfinite(value); }))
        throw Error("frequency curve", "has a frequency that is not finite");
    for (std::size_t i = 1; i < m_hz.size(); ++i)
        m_cycles[i] = m_cycles[i - 1] + 0.5 * (m_hz[i - 1] + m_hz[i]) * m_time.step;
}

double FrequencyCurve::meanHz() const
{
    return std::accumulate(m_hz.begin(), m_hz.end(), 0.0) / double(m_hz.size());
}

double FrequencyCurve::at(double seconds) const
{
    const double position = std::clamp(m_time.position(seconds), 0.0, double(m_hz.size() - 1));
    const auto lower = std::min(std::size_t(position), m_hz.size() - 1);
    const std::size_t upper = std::min(lower + 1, m_hz.size() - 1);
    return m_hz[lower] + (position - double(lower)) * (m_hz[upper] - m_hz[lower]);
}

double FrequencyCurve::cyclesAt(double seconds) const
{
    const double position = m_time.position(seconds);
    const auto knot = std::size_t(std::clamp(std::floor(position), 0.0, double(m_hz.size() - 1)));
    const double after = seconds - m_time.value(double(knot));
    return m_cycles[knot] + 0.5 * (m_hz[knot] + at(seconds)) * after;
}

double FrequencyCurve::secondsAt(double cycles) const
{
    const auto above = std::upper_bound(m_cycles.begin(), m_cycles.end(), cycles) - m_cycles.begin();
    const auto knot = std::size_t(std::max<std::ptrdiff_t>(0, above - 1));
    const double after = cycles - m_cycles[knot];
    const bool isBetween = above > 0 && knot + 1 < m_hz.size();
    const double slope = isBetween ? (m_hz[knot + 1] - m_hz[knot]) / m_time.step : 0.0;
    // The root of ½·slope·τ² + f·τ = after, in the form without cancellation.
    const double root = std::sqrt(std::max(0.0, m_hz[knot] * m_hz[knot] + 2.0 * slope * after));
    return m_time.value(double(knot)) + 2.0 * after / (m_hz[knot] + root);
}

} // namespace faintline
