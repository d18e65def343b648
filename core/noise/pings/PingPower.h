#pragma once

#include "signal/RawPings.h"

#include <memory>
#include <span>

namespace faintline {

/// Recorded pings as power, in a unit that makes the median of the first pings 1.
///
///   power p = x,  magnitude p = x²,  decibels p = 10^(x/10),  complex p = I² + Q²
///
/// Integers get a uniform random number within ± half their step added first, a function of ping and cell, so that
/// faint noise has a continuous law. Negative power counts as 0; numbers that are not finite become NaN, not observed.
/// Thread-safe; pure functions of (file, kind of values, ping).
class PingPower
{
public:
    /// `values`: Power, Magnitude or Decibels; it does not matter if the pings are complex. Throws Error as
    /// RawPings::read does.
    PingPower(std::shared_ptr<const RawPings> pings, PingValues values);

    /// Writes pings first … first+count-1, one value per cell.
    void read(Index first, Index count, std::span<float> out) const;

    const RawPings &pings() const { return *m_pings; }
    const Axis &time() const { return m_pings->info().time; }
    const Grid &grid() const { return m_pings->info().grid; }

private:
    double powerOf(double value) const;
    std::vector<double> powers(Index first, Index count) const;

    std::shared_ptr<const RawPings> m_pings;
    PingValues m_values;
    double m_unit = 1.0;
};

} // namespace faintline
