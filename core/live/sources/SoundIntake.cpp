#include "live/sources/SoundIntake.h"

#include <utility>

namespace faintline {

SoundIntake::SoundIntake(Index frameBytes, std::size_t capacity) : m_frameBytes(frameBytes), m_capacity(capacity)
{
    m_filled.reserve(capacity);
    m_taken.reserve(capacity);
}

void SoundIntake::put(std::span<const std::byte> block, Index lostBefore)
{
    {
        const std::lock_guard lock(m_mutex);
        (m_filled.empty() ? m_lostBefore : m_lostAfter) += lostBefore;
        if (m_lostAfter > 0 || m_filled.size() + block.size() > m_capacity)
            m_lostAfter += std::ssize(block) / m_frameBytes; // one loss at a time, until these samples are taken
        else
            m_filled.insert(m_filled.end(), block.begin(), block.end());
    }
    m_came.notify_one();
}

Heard SoundIntake::take(std::chrono::milliseconds patience)
{
    Heard heard;
    {
        std::unique_lock lock(m_mutex);
        m_came.wait_for(lock, patience, [this] { return !m_filled.empty(); });
        std::swap(m_filled, m_taken);
        heard.lostSamples = std::exchange(m_lostBefore, std::exchange(m_lostAfter, 0));
    }
    heard.bytes.assign(m_taken.begin(), m_taken.end());
    m_taken.clear();
    return heard;
}

} // namespace faintline
