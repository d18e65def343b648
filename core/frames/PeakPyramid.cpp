#include "frames/PeakPyramid.h"

#include "base/fastmath.h"
#include "base/multiversion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace faintline {

namespace {

    constexpr Index branching = 4;
    constexpr Index chunkBytes = Index(1) << 18;

    FAINTLINE_MULTIVERSION
    void raise(std::uint8_t *to, const std::uint8_t *from, Index n)
    {
        for (Index i = 0; i < n; ++i)
            to[i] = std::max(to[i], from[i]);
    }

    FAINTLINE_MULTIVERSION
    void encodePower(const float *values, std::uint8_t *bytes, Index n)
    {
        constexpr float stepsPerNeper = 8.6858896381f;                                 // 2 · 10 / ln 10
        constexpr auto bitsOfLowestPower = std::bit_cast<std::int32_t>(0.0316227766f); // -15 dB
        constexpr auto infinite = std::bit_cast<std::int32_t>(std::numeric_limits<float>::infinity());
        for (Index i = 0; i < n; ++i) {
            // Positive floats have the same order as integers; a comparison of floats would prevent vectorisation.
            const auto given = std::bit_cast<std::int32_t>(values[i]);
            const std::int32_t bits =
                given > infinite ? bitsOfLowestPower : std::max(given, bitsOfLowestPower); // NaN: lowest
            const auto byte = std::int32_t(stepsPerNeper * fastLn(std::bit_cast<float>(bits)) + 30.5f);
            bytes[i] = std::uint8_t(std::min(byte, 255));
        }
    }

    constexpr int endOfEven = 200; ///< first byte of a score that is more than ¼ nat above the previous one

    /// Returns whether there are scores beyond the even part; their bytes are `endOfEven`.
    FAINTLINE_MULTIVERSION
    bool encodeEvenScores(const float *values, std::uint8_t *bytes, Index n)
    {
        std::int32_t most = 0;
        for (Index i = 0; i < n; ++i) {
            const float position = 4.0f * (values[i] + 4.0f) + 0.5f;
            const float inside = position > 0.0f ? position : 0.0f; // also for NaN
            const auto byte = std::int32_t(inside < float(endOfEven) ? inside : float(endOfEven));
            bytes[i] = std::uint8_t(byte);
            most = std::max(most, byte);
        }
        return most >= endOfEven;
    }

    double valueOf(ByteScale::Kind kind, int byte)
    {
        switch (kind) {
        case ByteScale::Kind::PowerDb:
            break;
        case ByteScale::Kind::ScoreNats:
            return byte <= 200 ? -4.0 + 0.25 * byte : 46.0 * std::pow(1.15, byte - 200);
        case ByteScale::Kind::DifferenceNats: {
            const int level = byte / 2;
            const double magnitude = level <= 96 ? 0.25 * level : 24.0 * std::pow(1.3, level - 96);
            return byte % 2 == 1 || level == 0 ? magnitude : -magnitude;
        }
        }
        return -15.0 + 0.5 * byte;
    }

    /// The nearest byte of a difference: by magnitude among the positive ones, which ascend, then the sign.
    std::uint8_t differenceByte(const std::vector<float> &values, double value)
    {
        if (std::isnan(value))
            return 0;
        const double magnitude = std::abs(value);
        int low = 0;
        int high = 127;
        while (high - low > 1) {
            const int middle = (low + high) / 2;
            (double(values[std::size_t(2 * middle + 1)]) <= magnitude ? low : high) = middle;
        }
        const auto at = [&](int level) { return double(values[std::size_t(2 * level + 1)]); };
        const int nearest = at(high) - magnitude < magnitude - at(low) ? high : low;
        return std::uint8_t(2 * nearest + (value > 0.0 && nearest > 0 ? 1 : 0));
    }

} // namespace

ByteScale::ByteScale(Kind kind) : m_kind(kind), m_values(256)
{
    for (int byte = 0; byte < 256; ++byte)
        m_values[std::size_t(byte)] = float(valueOf(kind, byte));
}

std::vector<int> ByteScale::ascending() const
{
    std::vector<int> bytes(256);
    std::iota(bytes.begin(), bytes.end(), 0);
    std::stable_sort(bytes.begin(), bytes.end(), [this](int a, int b) { return value(a) < value(b); });
    return bytes;
}

std::uint8_t ByteScale::byte(double value) const
{
    if (m_kind == Kind::DifferenceNats)
        return differenceByte(m_values, value);
    if (!(value > double(m_values.front())))
        return 0;
    const auto upper = std::upper_bound(m_values.begin(), m_values.end(), float(value));
    if (upper == m_values.end())
        return 255;
    const auto lower = upper - 1;
    const bool nearer = double(*upper) - value < value - double(*lower);
    return std::uint8_t((nearer ? upper : lower) - m_values.begin());
}

void ByteScale::encode(std::span<const float> values, std::span<std::uint8_t> bytes) const
{
    if (m_kind == Kind::PowerDb) {
        encodePower(values.data(), bytes.data(), std::ssize(values));
        return;
    }
    if (m_kind == Kind::DifferenceNats) {
        for (std::size_t i = 0; i < values.size(); ++i)
            bytes[i] = byte(double(values[i]));
        return;
    }
    // The even part of the scale covers nearly all cells; the others are searched individually.
    if (!encodeEvenScores(values.data(), bytes.data(), std::ssize(values)))
        return;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (bytes[i] >= endOfEven)
            bytes[i] = byte(double(values[i]));
}

PeakPyramid::PeakPyramid(Axis time, Index cells, ByteScale scale, std::size_t byteBudget)
    : m_time(std::move(time)), m_cells(cells), m_scale(std::move(scale)), m_byteBudget(Index(byteBudget)),
      m_chunkRows(std::max<Index>(1, chunkBytes / std::max<Index>(1, cells))), m_levels(1), m_pending(1)
{
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
    const auto l = std::size_t(level);
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
    add(m_levels[l], pending.row);
    const std::vector<std::uint8_t> whole = pending.row; // copied because the vectors may move
    push(level + 1, whole);
    if (level == 0 && bytes() > m_byteBudget)
        coarsen();
}

void PeakPyramid::coarsen()
{
    // Level 1 becomes level 0; the rows of level 0 that are not yet in it are in its pending row.
    if (m_levels.size() < 2 || m_levels[1].rows == 0)
        return;
    m_baseFrames *= branching;
    m_levels.erase(m_levels.begin());
    Pending first = m_pending[1];
    first.count = first.count * (m_baseFrames / branching);
    m_pending.erase(m_pending.begin());
    m_pending[0] = std::move(first);
}

void PeakPyramid::add(PyramidLevel &level, std::span<const std::uint8_t> row) const
{
    const Index place = level.rows++ % m_chunkRows;
    if (place == 0)
        level.chunks.push_back(std::make_shared_for_overwrite<std::uint8_t[]>(std::size_t(m_chunkRows * m_cells)));
    std::copy(row.begin(), row.end(), level.chunks.back().get() + place * m_cells);
}

Index PeakPyramid::bytes() const
{
    Index rows = 0;
    for (const PyramidLevel &level : m_levels)
        rows += level.rows;
    return rows * m_cells;
}

PeakPyramid PeakPyramid::soFar() const
{
    PeakPyramid copy = *this;
    for (PyramidLevel &level : copy.m_levels) {
        const Index shared = level.rows % m_chunkRows;
        if (shared == 0)
            continue; // the next row goes to its own chunk
        const auto own = std::make_shared_for_overwrite<std::uint8_t[]>(std::size_t(m_chunkRows * m_cells));
        std::copy_n(level.chunks.back().get(), shared * m_cells, own.get());
        level.chunks.back() = own;
    }
    copy.finish();
    return copy;
}

void PeakPyramid::finish()
{
    for (std::size_t level = 0; level < m_levels.size(); ++level) {
        if (m_pending[level].count == 0)
            continue;
        const std::vector<std::uint8_t> row = m_pending[level].row;
        m_pending[level].count = 0;
        add(m_levels[level], row);
        if (level + 1 < m_levels.size()) {
            Pending &above = m_pending[level + 1];
            if (above.count++ == 0)
                above.row = row;
            else
                raise(above.row.data(), row.data(), m_cells);
        }
    }
    while (m_levels.size() > 1 && m_levels.back().rows == 0)
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
    const auto &chunks = m_levels[std::size_t(level)].chunks;
    return {chunks[std::size_t(row / m_chunkRows)].get() + row % m_chunkRows * m_cells, std::size_t(m_cells)};
}

int PeakPyramid::levelFor(double frames) const
{
    int level = 0;
    while (level + 1 < levelCount() && double(framesPerRow(level + 1)) <= frames)
        ++level;
    return level;
}

} // namespace faintline
