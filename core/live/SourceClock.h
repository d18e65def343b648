#pragma once

#include "base/Axis.h"

#include <optional>
#include <string>

namespace faintline {

/// How far a source's clock, which its samples count, has departed from this machine's.
///
/// Samples come late and in bursts, but never before their time: of each ten seconds the delivery that was late the
/// least is compared with the least late one of the first ten. What departs by 0.1 s is told of, then at twice as much,
/// and so on. Nothing is shifted: a recording's time is the time of its source.
class SourceClock
{
public:
    explicit SourceClock(double sampleRateHz) : m_rate(sampleRateHz) { restart(); }

    struct Departure {
        Index samples = 0; ///< that this machine's clock has gone further than the source; negative: it is ahead
        double ppm = 0.0;  ///< the same, of the time since the beginning
        std::string words; ///< one sentence
    };

    /// So many samples have been counted, lost ones included, at this time of this machine's clock, s.
    std::optional<Departure> note(Index counted, double seconds);
    /// The source was away: begins anew.
    void restart();

private:
    struct Interval {
        double begin = 0.0;
        double leastLate = 0.0; ///< s
        double at = 0.0;        ///< when that was
    };

    std::optional<Departure> departureIn(const Interval &interval);

    double m_rate;
    std::optional<Interval> m_first; ///< once it is complete
    std::optional<Interval> m_current;
    double m_worthTelling; ///< departures from there on are, s
};

} // namespace faintline
