#include "recording/Recording.h"

#include "base/multiversion.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace faintline {

namespace {

    /// Sets what is not finite to 0; returns how many there were.
    FAINTLINE_MULTIVERSION
    Index clearNonFinite(float *values, std::size_t n)
    {
        constexpr std::uint32_t exponent = 0x7f800000u;
        Index found = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const auto bits = std::bit_cast<std::uint32_t>(values[i]);
            const bool isFinite = (bits & exponent) != exponent;
            values[i] = std::bit_cast<float>(isFinite ? bits : 0u);
            found += isFinite ? 0 : 1;
        }
        return found;
    }

} // namespace

void Recording::fill(Index first, Index count, std::span<float> out,
                     const std::function<void(Index first, std::span<float> out)> &fetch) const
{
    const Index floats = m_info.floatsPerSample();
    out = out.first(static_cast<std::size_t>(std::max<Index>(count, 0) * floats));
    const Index begin = std::clamp<Index>(first, 0, m_info.sampleCount);
    const Index end = first >= m_info.sampleCount ? begin : std::clamp<Index>(first + count, begin, m_info.sampleCount);
    if (begin == end) {
        std::fill(out.begin(), out.end(), 0.0f);
        return;
    }
    const std::size_t before = static_cast<std::size_t>((begin - first) * floats);
    const std::span<float> inside = out.subspan(before, static_cast<std::size_t>((end - begin) * floats));
    std::fill(out.begin(), out.begin() + static_cast<Index>(before), 0.0f);
    std::fill(out.begin() + static_cast<Index>(before + inside.size()), out.end(), 0.0f);
    fetch(begin, inside);
    if (const Index found = clearNonFinite(inside.data(), inside.size()))
        m_nonFiniteCount.fetch_add(found, std::memory_order_relaxed);
}

} // namespace faintline
