#pragma once

#include "spectrum/CausalLevels.h"
#include "spectrum/NoiseBackground.h"
#include "spectrum/blockBackground.h"

#include <deque>
#include <span>
#include <vector>

namespace faintline {

/// What a causal background is made of, in windows and frames.
struct CausalGeometry {
    Index cells = 0;          ///< one bin a resolution cell
    Index stepsPerWindow = 1; ///< detector's frames per window
    Index blockWindows = 0;   ///< windows of a block
    Index halfWidthCells = 0; ///< half the frequency window
    bool followsLevel = true;
    double likeness = 1.0; ///< cells that tell as much as one (cellLikeness)
    double overlap = 1.0;  ///< by how much overlapping frames scatter more in the mean

    /// Windows from one renewal of the colour to the next: a quarter of a block.
    Index renewalWindows() const { return blockWindows / 4 > 0 ? blockWindows / 4 : 1; }
    /// Frames from one level to the next: at most four levels a window.
    Index levelFrames() const { return stepsPerWindow > 4 ? stepsPerWindow / 4 : 1; }
};

/// The background of each frame from that frame and those before it, frame by frame.
///
/// The same estimate as NoiseBackground's, of the past alone. Its colour is renewed every quarter of a block, from the
/// medians over time of the last `blockWindows` windows that are not silent, averaged with up to six blocks before them
/// for as long as the noise keeps its colour; until the next renewal it stays. Over it lie the levels of each frame
/// (CausalLevels). The first block's frames have the colour of that block, so that no frame's background is known worse
/// than from a block: nothing comes before `blockWindows` windows are there, and from then on each frame has its
/// background at once, delay 0.
///
/// What is known from few windows scatters, and an excess ε of y that stays as long as a path does raises its false
/// alarms by e^(Bε). Where ε is normal with variance σ², their mean is raised by e^(½B²σ²), and the background is
/// raised by ½Bσ² to keep it: σ² = likeness/(ln²2 · windows · cells), of n blocks 1/n, with B = 30 (docs/theory.md).
///
/// Of noise from several sources in turn (NoiseStretch) nothing is known: that takes a stretch of a dozen blocks.
/// Copies go on independently. Memory: a block, and 25 rows of cells. Not thread-safe.
class CausalBackground
{
public:
    /// `frequency`: the cells, in Hz; `firstBlock`: windows × cells, `blockWindows` of them, fewer of what is shorter.
    CausalBackground(const CausalGeometry &geometry, const Axis &frequency, std::span<const float> firstBlock);

    /// Takes the power of the next frame, cells of them, from the first frame on: its background, at any time.
    const NoiseBackground &next(std::span<const float> power);

    /// The newest frame's, or the first block's.
    const NoiseBackground &latest() const { return m_background; }

    std::size_t bytes() const; ///< that it takes

private:
    void keepWindow(std::span<const float> power);
    void renew();
    double marginOf(std::size_t blocks) const;

    CausalGeometry m_geometry;
    Index m_cells;
    Index m_bands;
    Index m_frame = 0; ///< the next one's number
    Index m_firstBlockWindows;
    std::vector<float> m_windows;         ///< of the last block, oldest first
    Index m_sinceRenewal = 0;             ///< windows that were not silent
    std::deque<BlockBackground> m_blocks; ///< at each renewal, the newest last
    BlockBackground m_colour;             ///< in use: averaged
    CausalLevels m_levels;
    NoiseBackground m_background; ///< of the newest frame
};

} // namespace faintline
