#pragma once

#include "base/Axis.h"

#include <optional>
#include <string>

namespace faintline {

/// Measures how far a source's clock, given by its sample count, has drifted from this machine's.
///
/// Samples may arrive late and in bursts, but never early: the least late delivery of each ten seconds is compared with
/// that of the first ten. A departure is reported when it reaches 0.1 s, and again each time it doubles. Times are not
/// corrected: a recording keeps the source's time.
class SourceClock
{
public:
    explicit SourceClock(double sampleRateHz) : m_rate(sampleRateHz) { restart(); }

    struct Departure {
        Index samples = 0; ///< by which this machine's clock leads the source's; negative: source leads
        double ppm = 0.0;  ///< the same, relative to the elapsed time
        std::string words; ///< one sentence
    };

    /// Takes the number of samples counted, lost ones included, at time `seconds` of this machine's clock.
    std::optional<Departure> note(Index counted, double seconds);
    /// Starts over, after an interruption of the source.
    void restart();

private:
    struct Interval {
        double begin = 0.0;
        double leastLate = 0.0; ///< s
        double at = 0.0;        ///< time of the least late delivery
    };

    std::optional<Departure> departureIn(const Interval &interval);

    double m_rate;
    std::optional<Interval> m_first; ///< once complete
    std::optional<Interval> m_current;
    double m_worthTelling; ///< next departure to report, s
};

} // namespace faintline
