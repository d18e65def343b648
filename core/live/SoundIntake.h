#pragma once

#include "live/SampleSource.h"

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <span>
#include <vector>

namespace faintline {

/// Where a device's thread leaves samples for the one that hears them. The former never waits: what does not fit is
/// lost, and counted at its place.
class SoundIntake
{
public:
    /// `frameBytes`: of one sample of every channel.
    SoundIntake(Index frameBytes, std::size_t capacity);

    /// Of the device's thread: samples that come next, after so many that it lost itself.
    void put(std::span<const std::byte> block, Index lostBefore = 0);

    /// What came up to the next loss, with the loss before it; after at most `patience`, and then it may be nothing.
    Heard take(std::chrono::milliseconds patience);

private:
    Index m_frameBytes;
    std::size_t m_capacity;
    std::mutex m_mutex;
    std::condition_variable m_came;
    std::vector<std::byte> m_filled;
    std::vector<std::byte> m_taken;
    Index m_lostBefore = 0; ///< the first of those that are filled in
    Index m_lostAfter = 0;  ///< the last of them, so far
};

} // namespace faintline
