#include "frames/FrameStream.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr std::size_t blockBytes = std::size_t(1) << 20;

} // namespace

FrameStream::FrameStream(const NormalisedFrames &frames, bool readsAhead)
    : FrameStream(frames, readsAhead, 0, frames.time().count)
{
}

FrameStream::FrameStream(const NormalisedFrames &frames, bool readsAhead, Index first, Index end)
    : m_frames(frames), m_readsAhead(readsAhead),
      m_blockFrames(std::max<Index>(1, Index(blockBytes / sizeof(float)) / std::max<Index>(1, frames.grid().size()))),
      m_position(first), m_end(end)
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
