#include "analyse/LiveFrames.h"

#include "base/memoryShares.h"

#include <algorithm>
#include <limits>

namespace faintline {

LiveFrames::LiveFrames(NormalisedFramesPointer of, Index wholeFrames, Index halfWidth)
    : NormalisedFrames(of->time(), of->grid()), m_of(std::move(of)), m_wholeFrames(wholeFrames), m_halfWidth(halfWidth)
{
    m_time.count = 0;
}

void LiveFrames::append(Index frame, std::span<const float> y)
{
    if (m_frames.empty())
        m_first = frame;
    m_frames.push_back({{{0, {y.begin(), y.end()}}}, {}, m_of->isObserved(frame)});
    m_time.count = frame + 1;
    if (std::ssize(m_frames) <= m_wholeFrames)
        return;
    KeptFrame &older = m_frames[m_frames.size() - std::size_t(m_wholeFrames) - 1];
    thinOut(older, m_halfWidth);
    m_thinnedBytes += bytesOf(older);
    while (m_thinnedBytes > memoryShares::pathRecord)
        dropFirst();
}

void LiveFrames::forgetBefore(Index frame)
{
    while (m_first < frame && std::ssize(m_frames) > m_wholeFrames)
        dropFirst();
}

void LiveFrames::dropFirst()
{
    m_thinnedBytes -= bytesOf(m_frames.front());
    m_frames.pop_front();
    ++m_first;
}

std::size_t LiveFrames::bytesOf(const KeptFrame &frame)
{
    std::size_t bytes = sizeof frame;
    for (const KeptCells &cells : frame.kept)
        bytes += sizeof cells + cells.y.capacity() * sizeof(float);
    return bytes;
}

void LiveFrames::mark(Index frame, Index cell)
{
    if (frame >= std::max(m_first, m_time.count - m_wholeFrames) && frame < m_time.count)
        m_frames[std::size_t(frame - m_first)].marks.push_back(cell);
}

void LiveFrames::thinOut(KeptFrame &frame, Index halfWidth)
{
    const std::vector<float> whole = std::move(frame.kept.front().y);
    frame.kept.clear();
    std::ranges::sort(frame.marks);
    Index done = 0; // cells before this one are kept, or not needed
    for (const Index cell : frame.marks) {
        const Index from = std::clamp<Index>(cell - halfWidth, done, std::ssize(whole));
        done = std::clamp<Index>(cell + halfWidth + 1, from, std::ssize(whole));
        if (from < done)
            frame.kept.push_back({from, {whole.begin() + from, whole.begin() + done}});
    }
    frame.marks = {};
}

bool LiveFrames::isObserved(Index frame) const
{
    const Index at = frame - m_first;
    return at >= 0 && at < std::ssize(m_frames) && m_frames[std::size_t(at)].isObserved;
}

void LiveFrames::read(Index first, Index count, std::span<float> out) const
{
    std::ranges::fill(out, std::numeric_limits<float>::quiet_NaN());
    const Index size = grid().size();
    for (Index frame = std::max(first, m_first); frame < std::min(first + count, m_time.count); ++frame)
        for (const KeptCells &cells : m_frames[std::size_t(frame - m_first)].kept)
            std::ranges::copy(cells.y, out.begin() + (frame - first) * size + cells.first);
}

} // namespace faintline
