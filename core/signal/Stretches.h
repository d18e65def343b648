#pragma once

#include "base/Axis.h"

#include <functional>
#include <span>
#include <vector>

namespace faintline {

/// Places in time of samples that are stored contiguously although some are missing between them.
///
/// Stretches without a gap, in ascending order. Time between them was not observed: it reads as 0, and `isWhole`
/// reports it.
class Stretches
{
public:
    /// A longer gap is taken for a wrongly set clock.
    static constexpr double longestSeconds = 400.0 * 86400.0;

    /// Adds `count` samples, stored from `stored` on, the first of which was taken at `inTime`. Samples that follow the
    /// previous ones without a gap extend their stretch. Precondition: inTime ≥ end().
    void add(Index inTime, Index stored, Index count);

    bool hasGaps() const { return m_stretches.size() > 1; }
    Index gaps() const { return hasGaps() ? std::ssize(m_stretches) - 1 : 0; }
    Index missing() const; ///< samples in all gaps
    Index samples() const; ///< in all stretches
    Index end() const;     ///< one past the last sample, in time
    /// The largest number of samples such that half of all lie in stretches of at least as many; 0: there are none.
    Index typicalCount() const;

    /// Index among the stored samples of a place in time, or of the first stored one behind it; without any stretch they
    /// are equal. In a place beyond the end, time goes on.
    Index storedAt(Index inTime) const;
    /// Place in time of the first sample of the next stretch; end() or the next integer, if larger, behind the last one.
    Index nextStretch(Index inTime) const;
    /// Place in time of a stored sample.
    Index inTimeOf(Index stored) const;

    /// Whether all of these samples that lie before the end were observed.
    bool isWhole(Index first, Index count) const;

    /// Fills `out` from a place in time on: 0 in gaps, `fetch(stored, part)` for each observed part.
    void read(Index first, Index floatsPerSample, std::span<float> out,
              const std::function<void(Index stored, std::span<float> part)> &fetch) const;

private:
    struct StoredRun {
        Index inTime;
        Index stored;
        Index count;
        Index end() const { return inTime + count; }
    };
    std::vector<StoredRun>::const_iterator stretchOf(Index sample) const;

    std::vector<StoredRun> m_stretches;
};

} // namespace faintline
