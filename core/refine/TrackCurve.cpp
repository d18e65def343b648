#include "refine/TrackCurve.h"

#include <algorithm>
#include <cmath>

namespace faintline {

TrackCurve::TrackCurve(const Track &track, const Axis &time, const Axis &frequency)
    : m_start(time.value(double(track.onsetFrame))), m_step(time.step)
{
    for (const SmoothedPoint &point : track.smoothed)
        m_hz.push_back(frequency.value(point.position));
}

double TrackCurve::at(double seconds) const
{
    const double place = std::clamp((seconds - m_start) / m_step, 0.0, double(m_hz.size() - 1));
    const auto i = std::size_t(place);
    return std::lerp(m_hz[i], m_hz[std::min(i + 1, m_hz.size() - 1)], place - double(i));
}

double TrackCurve::movement2(double window, int windows) const
{
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < m_hz.size() && secondsAt(i) + double(windows) * window <= end(); ++i) {
        const double t = secondsAt(i);
        const double one = at(t + window) - at(t);
        sum += one * (windows == 1 ? one : at(t + 2.0 * window) - at(t + window));
        count += 1.0;
    }
    return count > 0.0 ? std::max(0.0, sum / count) * window * window : 0.0;
}

} // namespace faintline
