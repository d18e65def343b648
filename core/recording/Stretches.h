#pragma once

#include "base/Axis.h"

#include <functional>
#include <span>
#include <vector>

namespace faintline {

/// Where samples lie in time that are stored one after the other though some are missing between them.
///
/// Stretches without a gap, in ascending order. What lies between them was not observed: it keeps its place in time and
/// reads as 0, and `isWhole` tells.
class Stretches
{
public:
    /// A gap that is longer than this is no gap, but a clock that was set wrongly.
    static constexpr double longestSeconds = 400.0 * 86400.0;

    /// `count` samples, stored from `stored` on, whose first one was heard at `inTime`. Those that follow the ones
    /// before without a gap belong to their stretch. Precondition: inTime ≥ end().
    void add(Index inTime, Index stored, Index count);

    bool hasGaps() const { return m_stretches.size() > 1; }
    Index gaps() const { return hasGaps() ? std::ssize(m_stretches) - 1 : 0; }
    Index missing() const; ///< samples in all gaps
    Index samples() const; ///< in all stretches
    Index end() const;     ///< behind the last sample, in time

    /// Whether all of these samples were heard, of those that lie before the end.
    bool isWhole(Index first, Index count) const;

    /// Fills `out` from a place in time on: 0 in gaps, `fetch(stored, part)` for every part that was heard.
    void read(Index first, Index floatsPerSample, std::span<float> out,
              const std::function<void(Index stored, std::span<float> part)> &fetch) const;

private:
    struct Stretch {
        Index inTime;
        Index stored;
        Index count;
        Index end() const { return inTime + count; }
    };
    std::vector<Stretch>::const_iterator stretchOf(Index sample) const;

    std::vector<Stretch> m_stretches;
};

} // namespace faintline
