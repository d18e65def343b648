#pragma once

#include "spectrum/NoiseBackground.h"
#include "spectrum/blockBackground.h"

#include <limits>
#include <span>
#include <vector>

namespace faintline {

// Levels of noise in sub-bands, frame by frame: how they are measured, and what of them counts.

inline constexpr float levelNotKnown = std::numeric_limits<float>::max();

/// ln of each frame's level over its block's background, frames × (bands + 1): per sub-band the mean of its cells of
/// noise, then the whole band's common one, from the sub-bands that agree with the median sub-band. `levelNotKnown` in
/// digital silence. Sub-bands that are mostly lines or empty have no say in what is common, and go with it where
/// nothing of them is noise.
std::vector<float> levelsOf(std::span<const float> frames, const BlockBackground &block, Index bands, double likeness);

/// Medians over the frames of each column of levels.
std::vector<float> mediansOf(const std::vector<float> &levels, Index columns);

/// As much of a sub-band's median level over a long time as lines may make, and chance hardly does.
float shareOfLines(float median);

/// What a block's levels are too high by, column by column. Levels tell what changes within a block: their median over
/// it is 0, but for the skirts of lines, which means over cells hold more of than the row, from medians over time,
/// does.
struct LevelOffsets {
    std::vector<float> medians;
    std::vector<bool> isSure; ///< beyond their own deviation: the cells are not exponential (crowded with lines)

    LevelOffsets(const std::vector<float> &levels, Index columns);
};

/// Takes offsets off levels: the sure ones of each block, else those of sub-bands over a dozen blocks, as far as lines
/// may make them.
void removeOffsets(std::vector<float> &levels, const std::vector<LevelOffsets> &offsets,
                   const std::vector<Index> &blockOfLevel);

/// What the blocks were measured with, one by one: ln powers smoothed over frequency, and which cells are noise (blocks
/// × cells).
struct BlockRows {
    std::vector<float> lnPower;
    std::vector<bool> isNoise;
};

/// Levels over each window's own block, whose row they were measured with, → levels over the averaged and interpolated
/// background.
void moveToBackground(std::vector<float> &levels, const BlockRows &rows, const NoiseBackground &background,
                      const std::vector<Index> &blockOfLevel);

/// Mean of one row of ln powers over another, of the cells of noise in each of `bands` sub-bands and, last, in the
/// whole band.
std::vector<double> meanOver(const float *upper, const float *lower, std::vector<bool>::const_iterator isNoise,
                             Index cells, Index bands);

/// From the levels measured to those that count, per sub-band: what the common level does beyond its errors, then what
/// a sub-band does besides.
std::vector<float> finishLevels(const std::vector<float> &levels, const NoiseBackground &background, double overlap,
                                double likeness);

} // namespace faintline
