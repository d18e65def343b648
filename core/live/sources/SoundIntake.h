#pragma once

#include "live/sources/SampleSource.h"

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <span>
#include <vector>

namespace faintline {

/// Passes samples from a device's thread to the reading thread. The device's thread never blocks; samples that do not
/// fit are dropped and counted at their position.
class SoundIntake
{
public:
    /// `frameBytes`: size of one sample of all channels.
    SoundIntake(Index frameBytes, std::size_t capacity);

    /// Called by the device's thread: appends samples, preceded by `lostBefore` that the device itself dropped.
    void put(std::span<const std::byte> block, Index lostBefore = 0);

    /// Samples up to the next loss, with the loss before them; waits at most `patience` and may return none.
    Heard take(std::chrono::milliseconds patience);

private:
    Index m_frameBytes;
    std::size_t m_capacity;
    std::mutex m_mutex;
    std::condition_variable m_came;
    std::vector<std::byte> m_filled;
    std::vector<std::byte> m_taken;
    Index m_lostBefore = 0; ///< lost before the samples in m_filled
    Index m_lostAfter = 0;  ///< lost after them, so far
};

} // namespace faintline
