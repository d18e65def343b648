#pragma once

#include <span>

namespace faintline {

/// Range of ln K on settled noise: mean ± 4 standard deviations. One global K regulates all states, so strong signals
/// without a track lower it, and thereby all other paths; a value outside the band shows that this has begun. Source:
/// Parsons 2008 has no such check; eight targets of 7 dB take K from -1.5 to -2.9 within 25 pings.
struct NoiseBand {
    double mean = 0.0;
    double deviation = 0.0;

    double low() const { return mean - 4.0 * deviation; }
    double high() const { return mean + 4.0 * deviation; }
    bool contains(double lnK) const { return lnK >= low() && lnK <= high(); }
};

/// The band of ln K values, one per frame, from settled noise. Precondition: at least two.
NoiseBand noiseBand(std::span<const double> lnK);

} // namespace faintline
