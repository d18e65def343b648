#pragma once

#include "base/Axis.h"
#include "noise/NoiseBackground.h"
#include "noise/bandLevels.h"
#include "noise/blockBackground.h"

#include <deque>
#include <span>
#include <vector>

namespace faintline {

/// Significant level changes of noise over its background, frame by frame, from past data alone.
///
/// A frame has levels of `bands` sub-bands and one common level of the whole band (levelsOf in bandLevels.h), in ln
/// power. The significant level of a sub-band is what the common level shows beyond its scatter plus what the sub-band
/// adds to that (latestBeyondScatter), minus the offset that lines cause (LevelOffsets). Levels before the first frame
/// are 0.
class CausalLevels
{
public:
    /// Standard errors of a frame's common level and of a sub-band's level.
    CausalLevels(Index bands, double commonScatter, double bandScatter);

    /// Adds the next frame's levels, bands + 1 values; levelNotKnown marks digital silence, which keeps the previous
    /// level.
    void push(std::span<const float> levels);

    /// Lowers the background to which all levels refer, by bands + 1 values.
    void moveBy(std::span<const double> rise);

    /// Subtracts offsets from now on: the sure ones, and for other sub-bands the part that lines may cause.
    void setOffsets(const LevelOffsets &offsets);

    /// Levels of the newest frame, `bands` values.
    std::vector<float> latest() const;

    std::size_t bytes() const { return m_levels.capacity() * sizeof(float); }

private:
    Index rows() const { return std::ssize(m_levels) / m_columns; }
    void readSeries(Index column, std::vector<float> &series) const;

    Index m_columns;
    double m_commonScatter;
    double m_bandScatter;
    std::vector<float> m_levels; ///< rows × columns, newest last; interpolated over silence
    std::vector<float> m_offsets;
};

/// Parameters of a causal background, in windows and frames.
struct CausalGeometry {
    Index cells = 0;          ///< one bin per resolution cell
    Index stepsPerWindow = 1; ///< frames of the detector per window
    Index blockWindows = 0;   ///< windows per block
    Index halfWidthCells = 0; ///< half the frequency window
    bool followsLevel = true;
    double likeness = 1.0; ///< number of cells equivalent to one independent cell (cellLikeness)
    double overlap = 1.0;  ///< standard error of a mean over overlapping frames, relative to independent ones

    /// Windows between renewals of the colour: a quarter of a block.
    Index renewalWindows() const { return blockWindows / 4 > 0 ? blockWindows / 4 : 1; }
    /// Frames between levels: at most four levels per window.
    Index levelFrames() const { return stepsPerWindow > 4 ? stepsPerWindow / 4 : 1; }
};

/// Estimates the background of each frame from that frame and previous ones, frame by frame.
///
/// The estimate is that of NoiseBackground, from past data alone. Its colour is renewed every quarter of a block from
/// the medians over time of the last `blockWindows` windows that are not silent, averaged with up to six preceding
/// blocks for as long as the noise keeps its colour, and is constant until the next renewal. The levels of each frame
/// (CausalLevels) are added. Frames of the first block use that block's colour, so that every background is estimated
/// from at least one block. Nothing is output until `blockWindows` windows have arrived; afterwards each frame has its
/// background immediately (delay 0).
///
/// A background estimated from few windows has an error: an excess ε of y that lasts as long as a path raises the rate
/// of false alarms by e^(Bε). If ε is normal with variance σ², their mean rises by e^(½B²σ²), and the background is
/// raised by ½Bσ² to compensate: σ² = likeness/(ln²2 · windows · cells), for n blocks 1/n of it, with B = 30
/// (docs/theory.md).
///
/// Several alternating sources (NoiseStretch) are not modelled, because that needs a stretch of a dozen blocks. Copies
/// continue independently. Memory: a block and 25 rows of cells. Not thread-safe.
class CausalBackground
{
public:
    /// `frequency`: the cells, in Hz; `firstBlock`: windows × cells, `blockWindows` of them, or fewer in a shorter
    /// recording.
    CausalBackground(const CausalGeometry &geometry, const Axis &frequency, std::span<const float> firstBlock);

    /// Takes the power of the next frame (one value per cell), starting with the first, and returns its background,
    /// valid at any time.
    const NoiseBackground &next(std::span<const float> power);

    /// Background of the newest frame, or of the first block.
    const NoiseBackground &latest() const { return m_background; }

    std::size_t bytes() const; ///< memory used

private:
    void keepWindow(std::span<const float> power);
    void renew();
    double marginOf(std::size_t blocks) const;

    CausalGeometry m_geometry;
    Index m_cells;
    Index m_bands;
    Index m_frame = 0; ///< number of the next frame
    Index m_firstBlockWindows;
    std::vector<float> m_windows;         ///< of the last block, oldest first
    Index m_sinceRenewal = 0;             ///< windows that were not silent
    std::deque<BlockBackground> m_blocks; ///< one per renewal, newest last
    BlockBackground m_colour;             ///< the averaged colour in use
    CausalLevels m_levels;
    NoiseBackground m_background; ///< of the newest frame
};

} // namespace faintline
