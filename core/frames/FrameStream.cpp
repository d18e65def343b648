#include "frames/FrameStream.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr std::size_t blockBytes = std::size_t(1) << 20;
    /// What detectors take at once (Recursion::framesAtOnce), if memory allows.
    constexpr std::size_t leastBlockFrames = 16;
    constexpr std::size_t largestBlockBytes = leastBlockFrames * blockBytes;

    Index blockFramesOf(Index cells)
    {
        const std::size_t frameBytes = sizeof(float) * std::size_t(std::max<Index>(1, cells));
        const std::size_t atLeast = std::clamp<std::size_t>(largestBlockBytes / frameBytes, 1, leastBlockFrames);
        return Index(std::max(blockBytes / frameBytes, atLeast));
    }

} // namespace

FrameStream::FrameStream(const NormalisedFrames &frames, bool readsAhead)
    : FrameStream(frames, readsAhead, 0, frames.time().count)
{
}

FrameStream::FrameStream(const NormalisedFrames &frames, bool readsAhead, Index first, Index end)
    : m_frames(frames), m_readsAhead(readsAhead), m_blockFrames(blockFramesOf(frames.grid().size())), m_position(first),
      m_end(end)
{
    if (m_readsAhead && m_position < m_end)
        prefetch();
}

std::vector<float> FrameStream::next()
{
    if (m_position >= m_end)
        return {};
    std::vector<float> block = m_readsAhead ? m_block.get() : read(m_position);
    m_position += std::ssize(block) / m_frames.grid().size();
    if (m_readsAhead && m_position < m_end)
        prefetch();
    return block;
}

std::vector<float> FrameStream::read(Index first) const
{
    const Index count = std::min(m_blockFrames, m_end - first);
    std::vector<float> block(std::size_t(count * m_frames.grid().size()));
    m_frames.read(first, count, block);
    return block;
}

void FrameStream::prefetch()
{
    m_block = std::async(std::launch::async, [this, first = m_position] { return read(first); });
}

} // namespace faintline
