#include "signal/Stretches.h"

#include <algorithm>
#include <functional>

namespace faintline {

void Stretches::add(Index inTime, Index stored, Index count)
{
    if (count <= 0)
        return;
    if (!m_stretches.empty()) {
        StoredRun &last = m_stretches.back();
        if (last.end() == inTime && last.stored + last.count == stored) {
            last.count += count;
            return;
        }
    }
    m_stretches.push_back({inTime, stored, count});
}

Index Stretches::missing() const
{
    Index missing = 0;
    for (std::size_t i = 1; i < m_stretches.size(); ++i)
        missing += m_stretches[i].inTime - m_stretches[i - 1].end();
    return missing;
}

Index Stretches::samples() const
{
    Index samples = 0;
    for (const StoredRun &each : m_stretches)
        samples += each.count;
    return samples;
}

Index Stretches::typicalCount() const
{
    std::vector<Index> counts;
    for (const StoredRun &each : m_stretches)
        counts.push_back(each.count);
    std::ranges::sort(counts, std::ranges::greater());
    Index left = samples() - samples() / 2;
    for (const Index count : counts)
        if (left -= count; left <= 0)
            return count;
    return 0;
}

Index Stretches::end() const
{
    return m_stretches.empty() ? 0 : m_stretches.back().end();
}

/// The first stretch that ends after a sample.
std::vector<Stretches::StoredRun>::const_iterator Stretches::stretchOf(Index sample) const
{
    return std::upper_bound(m_stretches.begin(), m_stretches.end(), sample,
                            [](Index wanted, const StoredRun &each) { return wanted < each.end(); });
}

Index Stretches::storedAt(Index inTime) const
{
    if (m_stretches.empty() || inTime < m_stretches.front().inTime)
        return inTime;
    const auto stretch = stretchOf(inTime);
    const StoredRun &own = stretch == m_stretches.end() ? m_stretches.back() : *stretch;
    return own.stored + std::max<Index>(0, inTime - own.inTime);
}

Index Stretches::nextStretch(Index inTime) const
{
    const auto next = std::upper_bound(m_stretches.begin(), m_stretches.end(), inTime,
                                       [](Index wanted, const StoredRun &each) { return wanted < each.inTime; });
    return next == m_stretches.end() ? std::max(end(), inTime + 1) : next->inTime;
}

Index Stretches::inTimeOf(Index stored) const
{
    const auto behind = std::upper_bound(m_stretches.begin(), m_stretches.end(), stored,
                                         [](Index wanted, const StoredRun &each) { return wanted < each.stored; });
    return behind == m_stretches.begin() ? stored : (behind - 1)->inTime + stored - (behind - 1)->stored;
}

bool Stretches::isWhole(Index first, Index count) const
{
    const Index to = std::min(first + count, end());
    Index from = std::max<Index>(0, first);
    for (auto stretch = stretchOf(from); from < to; ++stretch) {
        if (stretch->inTime > from)
            return false;
        from = stretch->end();
    }
    return true;
}

void Stretches::read(Index first, Index floatsPerSample, std::span<float> out,
                     const std::function<void(Index stored, std::span<float> part)> &fetch) const
{
    const Index to = first + std::ssize(out) / floatsPerSample;
    std::fill(out.begin(), out.end(), 0.0f);
    for (auto stretch = stretchOf(first); stretch != m_stretches.end() && stretch->inTime < to; ++stretch) {
        const Index begin = std::max(first, stretch->inTime);
        const Index end = std::min(to, stretch->end());
        fetch(stretch->stored + begin - stretch->inTime, out.subspan(std::size_t((begin - first) * floatsPerSample),
                                                                     std::size_t((end - begin) * floatsPerSample)));
    }
}

} // namespace faintline
