#pragma once

#include "base/Axis.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace faintline {

/// Values encoded as one byte, for pictures only; no decision is based on them.
///
/// Power: -15 … +112 dB in steps of ½ dB. Score: -4 … 46 nat in steps of ¼ nat, above in steps of 15 %, to 10⁵ nat.
/// Difference of scores: 0 … ±24 nat in steps of ¼ nat, above in steps of 30 %, to ±8·10⁴ nat; its bytes ascend by
/// magnitude with the sign in the lowest bit, so that the maximum of bytes is the difference of largest magnitude (the
/// positive one of two equal ones). Zero is byte 0; byte 1 is unused.
class ByteScale
{
public:
    enum class Kind { PowerDb, ScoreNats, DifferenceNats };

    explicit ByteScale(Kind kind = Kind::PowerDb);

    Kind kind() const { return m_kind; }
    /// The value of a byte, in dB or nat.
    double value(int byte) const { return double(m_values[std::size_t(byte)]); }
    /// The nearest byte of a value in dB or nat.
    std::uint8_t byte(double value) const;
    /// All bytes, sorted by value.
    std::vector<int> ascending() const;
    /// Encodes power ratios (PowerDb) or scores (ScoreNats, DifferenceNats).
    void encode(std::span<const float> values, std::span<std::uint8_t> bytes) const;

private:
    Kind m_kind;
    std::vector<float> m_values;
};

/// A picture of a whole recording that keeps its maxima: a line one bin wide survives zooming out.
///
/// Level 0 has one row per `framesPerRow` frames, each further level one row per four of the level below; a row is the
/// maximum, cell by cell, of the frames it covers. 1.33 bytes per cell. When the byte budget would be exceeded, rows of
/// level 0 are merged by four, so memory stays bounded for any length.
class PeakPyramid
{
public:
    PeakPyramid(Axis time, Index cells, ByteScale scale, std::size_t byteBudget = std::size_t(160) << 20);

    /// Appends the next frames, in order: whole rows of `cells` values.
    void append(std::span<const float> frames);
    /// Appends one frame that is already encoded as bytes of the scale.
    void appendBytes(std::span<const std::uint8_t> frame);

    /// Completes the last rows. Nothing may be appended afterwards.
    void finish();

    /// A finished copy of the picture so far, while this one continues. It shares all rows but the newest, so it is
    /// cheap; rows that are added later are not part of it.
    PeakPyramid soFar() const;

    const Axis &time() const { return m_time; } ///< of the frames
    Index cells() const { return m_cells; }
    const ByteScale &scale() const { return m_scale; }
    Index frameCount() const { return m_frameCount; }

    int levelCount() const { return int(m_levels.size()); }
    Index framesPerRow(int level) const;
    Index rowCount(int level) const { return m_levels[std::size_t(level)].rows; }
    std::span<const std::uint8_t> row(int level, Index row) const;

    /// The coarsest level whose rows cover at most `frames` frames each.
    int levelFor(double frames) const;

private:
    void push(int level, std::span<const std::uint8_t> row);
    void coarsen();
    Index bytes() const;

    /// Rows in chunks that never move, so that existing rows can be shared and read while more are added.
    struct PyramidLevel {
        std::vector<std::shared_ptr<std::uint8_t[]>> chunks;
        Index rows = 0;
    };
    void add(PyramidLevel &level, std::span<const std::uint8_t> row) const;

    Axis m_time;
    Index m_cells;
    ByteScale m_scale;
    Index m_byteBudget;
    Index m_chunkRows;
    Index m_baseFrames = 1; ///< frames per row of level 0
    Index m_frameCount = 0;
    std::vector<PyramidLevel> m_levels;
    struct Pending {
        std::vector<std::uint8_t> row;
        Index count = 0;
    };
    std::vector<Pending> m_pending; ///< of level 0 (in frames), 1, … (in rows of the level below)
};

} // namespace faintline
