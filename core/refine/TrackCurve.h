#pragma once

#include "track/Track.h"

#include <vector>

namespace faintline {

/// A track with a second pass over time and frequency, so that tracks of different windows can be compared.
class TrackCurve
{
public:
    TrackCurve(const Track &track, const Axis &time, const Axis &frequency);

    double start() const { return m_start; }
    double end() const { return secondsAt(m_hz.size() - 1); }
    double step() const { return m_step; } ///< from point to point, s
    std::size_t count() const { return m_hz.size(); }
    double secondsAt(std::size_t i) const { return m_start + double(i) * m_step; }
    double hzAt(std::size_t i) const { return m_hz[i]; }
    const std::vector<double> &hz() const { return m_hz; } ///< of all points

    /// Frequency at a time, interpolated; that of an end beyond it.
    double at(double seconds) const;

    /// Mean square of the movement within a window, or mean product of those in two successive ones, in cells²; 0 if it
    /// does not last for that.
    double movement2(double window, int windows) const;

private:
    double m_start;
    double m_step;
    std::vector<double> m_hz;
};

} // namespace faintline
