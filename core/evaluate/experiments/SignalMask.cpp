#include "evaluate/experiments/SignalMask.h"

#include <algorithm>

namespace faintline {

SignalMask::SignalMask(Index frames, Index bins) : m_bins(bins), m_stretches(std::size_t(frames)) {}

void SignalMask::add(Index frame, Index low, Index high)
{
    low = std::max<Index>(low, 0);
    high = std::min(high, m_bins - 1);
    if (frame < 0 || frame >= std::ssize(m_stretches) || low > high)
        return;
    auto &stretches = m_stretches[std::size_t(frame)];
    const auto first =
        std::find_if(stretches.begin(), stretches.end(), [low](const auto &one) { return one.second + 1 >= low; });
    auto last = first;
    for (; last != stretches.end() && last->first <= high + 1; ++last) {
        low = std::min(low, last->first);
        high = std::max(high, last->second);
    }
    stretches.insert(stretches.erase(first, last), {low, high});
}

bool SignalMask::touches(Index frame, Index low, Index high) const
{
    if (frame < 0 || frame >= std::ssize(m_stretches))
        return false;
    const auto &stretches = m_stretches[std::size_t(frame)];
    return std::any_of(stretches.begin(), stretches.end(),
                       [&](const auto &one) { return one.first <= high && one.second >= low; });
}

void SignalMask::blank(Index frame, Index firstBin, std::span<float> y) const
{
    for (const auto &[low, high] : m_stretches[std::size_t(frame)]) {
        const Index from = std::max<Index>(low - firstBin, 0);
        const Index to = std::min(high - firstBin, std::ssize(y) - 1);
        for (Index i = from; i <= to; ++i)
            y[std::size_t(i)] = 0.0f;
    }
}

double SignalMask::freeShare() const
{
    double taken = 0.0;
    for (const auto &stretches : m_stretches)
        for (const auto &[low, high] : stretches)
            taken += double(high - low + 1);
    return 1.0 - taken / (double(m_bins) * double(m_stretches.size()));
}

} // namespace faintline
