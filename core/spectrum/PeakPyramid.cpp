#include "spectrum/PeakPyramid.h"

#include "base/fastmath.h"
#include "base/multiversion.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace faintline {

namespace {

    constexpr Index branching = 4;

    FAINTLINE_MULTIVERSION
    void raise(std::uint8_t *to, const std::uint8_t *from, Index n)
    {
        for (Index i = 0; i < n; ++i)
            to[i] = std::max(to[i], from[i]);
    }

    FAINTLINE_MULTIVERSION
    void encodePower(const float *values, std::uint8_t *bytes, Index n)
    {
        constexpr float stepsPerNeper = 8.6858896381f;                      // 2 · 10 / ln 10
        constexpr auto lowest = std::bit_cast<std::int32_t>(0.0316227766f); // -15 dB
        for (Index i = 0; i < n; ++i) {
            // As whole numbers, positive floats have the same order; a comparison of floats keeps the compiler from vector code.
            const std::int32_t bits = std::max(std::bit_cast<std::int32_t>(values[i]), lowest);
            const auto byte = static_cast<std::int32_t>(stepsPerNeper * fastLn(std::bit_cast<float>(bits)) + 30.5f);
            bytes[i] = static_cast<std::uint8_t>(std::min(byte, 255));
        }
    }

    constexpr int endOfEven = 200; ///< of a score's bytes, the first that is not ¼ nat above the one before

    /// Returns whether there are scores beyond the even part; their bytes are `endOfEven`.
    FAINTLINE_MULTIVERSION
    bool encodeEvenScores(const float *values, std::uint8_t *bytes, Index n)
    {
        std::int32_t most = 0;
        for (Index i = 0; i < n; ++i) {
            const float position = 4.0f * (values[i] + 4.0f) + 0.5f;
            const float inside = position > 0.0f ? position : 0.0f; // NaN as well
            const auto byte = static_cast<std::int32_t>(inside < static_cast<float>(endOfEven) ? inside : static_cast<float>(endOfEven));
            bytes[i] = static_cast<std::uint8_t>(byte);
            most = std::max(most, byte);
        }
        return most >= endOfEven;
    }

} // namespace

ByteScale::ByteScale(Kind kind) : m_kind(kind), m_values(256)
{
    for (int byte = 0; byte < 256; ++byte) {
        double value = -15.0 + 0.5 * byte;
        if (kind == Kind::ScoreNats)
            value = byte <= 200 ? -4.0 + 0.25 * byte : 46.0 * std::pow(1.15, byte - 200);
        m_values[static_cast<std::size_t>(byte)] = static_cast<float>(value);
    }
}

std::uint8_t ByteScale::byte(double value) const
{
    if (!(value > static_cast<double>(m_values.front())))
        return 0;
    const auto upper = std::upper_bound(m_values.begin(), m_values.end(), static_cast<float>(value));
    if (upper == m_values.end())
        return 255;
    const auto lower = upper - 1;
    const bool nearer = static_cast<double>(*upper) - value < value - static_cast<double>(*lower);
    return static_cast<std::uint8_t>((nearer ? upper : lower) - m_values.begin());
}

void ByteScale::encode(std::span<const float> values, std::span<std::uint8_t> bytes) const
{
    if (m_kind == Kind::PowerDb) {
        encodePower(values.data(), bytes.data(), std::ssize(values));
        return;
    }
    // The even part of the scale covers nearly all cells; the rest goes the long way.
    if (!encodeEvenScores(values.data(), bytes.data(), std::ssize(values)))
        return;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (bytes[i] >= endOfEven)
            bytes[i] = byte(static_cast<double>(values[i]));
}

PeakPyramid::PeakPyramid(Axis time, Index cells, ByteScale scale, std::size_t byteBudget)
    : m_time(std::move(time)), m_cells(cells), m_scale(std::move(scale)), m_byteBudget(byteBudget), m_levels(1), m_pending(1)
{
    reserve();
}

void PeakPyramid::append(std::span<const float> frames)
{
    std::vector<std::uint8_t> row(static_cast<std::size_t>(m_cells));
    for (std::size_t offset = 0; offset < frames.size(); offset += row.size()) {
        m_scale.encode(frames.subspan(offset, row.size()), row);
        appendBytes(row);
    }
}

void PeakPyramid::appendBytes(std::span<const std::uint8_t> frame)
{
    ++m_frameCount;
    push(0, frame);
}

void PeakPyramid::push(int level, std::span<const std::uint8_t> row)
{
    const auto l = static_cast<std::size_t>(level);
    if (l == m_levels.size()) {
        m_levels.emplace_back();
        m_pending.emplace_back();
    }
    Pending &pending = m_pending[l];
    if (pending.count == 0)
        pending.row.assign(row.begin(), row.end());
    else
        raise(pending.row.data(), row.data(), m_cells);
    if (++pending.count < (level == 0 ? m_baseFrames : branching))
        return;
    pending.count = 0;
    m_levels[l].insert(m_levels[l].end(), pending.row.begin(), pending.row.end());
    const std::vector<std::uint8_t> whole = pending.row; // the vectors may move
    push(level + 1, whole);
    if (level == 0 && bytes() > m_byteBudget)
        coarsen();
}

void PeakPyramid::coarsen()
{
    // Level 1 becomes level 0; the rows of level 0 not yet in it are what its pending row holds.
    if (m_levels.size() < 2 || m_levels[1].empty())
        return;
    m_baseFrames *= branching;
    m_levels.erase(m_levels.begin());
    Pending first = m_pending[1];
    first.count = first.count * (m_baseFrames / branching);
    m_pending.erase(m_pending.begin());
    m_pending[0] = std::move(first);
    reserve();
}

/// A vector that grows by moving holds its rows twice while it does; memory that is only set aside costs nothing.
void PeakPyramid::reserve()
{
    const auto rows = static_cast<std::size_t>(std::max<Index>(0, m_time.count) / m_baseFrames + 1);
    const std::size_t most = m_byteBudget + static_cast<std::size_t>(m_cells);
    m_levels[0].reserve(std::min(most, rows * static_cast<std::size_t>(m_cells)));
}

std::size_t PeakPyramid::bytes() const
{
    std::size_t sum = 0;
    for (const auto &level : m_levels)
        sum += level.size();
    return sum;
}

void PeakPyramid::finish()
{
    for (std::size_t level = 0; level < m_levels.size(); ++level) {
        if (m_pending[level].count == 0)
            continue;
        const std::vector<std::uint8_t> row = m_pending[level].row;
        m_pending[level].count = 0;
        m_levels[level].insert(m_levels[level].end(), row.begin(), row.end());
        if (level + 1 < m_levels.size()) {
            Pending &above = m_pending[level + 1];
            if (above.count++ == 0)
                above.row = row;
            else
                raise(above.row.data(), row.data(), m_cells);
        }
    }
    while (m_levels.size() > 1 && m_levels.back().empty())
        m_levels.pop_back();
}

Index PeakPyramid::framesPerRow(int level) const
{
    Index frames = m_baseFrames;
    for (int l = 0; l < level; ++l)
        frames *= branching;
    return frames;
}

std::span<const std::uint8_t> PeakPyramid::row(int level, Index row) const
{
    const auto &values = m_levels[static_cast<std::size_t>(level)];
    return std::span(values).subspan(static_cast<std::size_t>(row * m_cells), static_cast<std::size_t>(m_cells));
}

int PeakPyramid::levelFor(double frames) const
{
    int level = 0;
    while (level + 1 < levelCount() && static_cast<double>(framesPerRow(level + 1)) <= frames)
        ++level;
    return level;
}

} // namespace faintline
