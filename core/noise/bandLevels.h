#pragma once

#include "noise/NoiseBackground.h"
#include "noise/blockBackground.h"

#include <limits>
#include <span>
#include <vector>

namespace faintline {

// Levels of noise in sub-bands, frame by frame: measurement and selection of significant changes.

inline constexpr float levelNotKnown = std::numeric_limits<float>::max();

/// ln of each frame's level over its block's background, frames × (bands + 1): for each sub-band the mean of its noise
/// cells, then the common level of the whole band, from the sub-bands that agree with the median sub-band.
/// `levelNotKnown` in digital silence. Sub-bands that are empty or mostly lines do not contribute to the common level,
/// and follow it if they contain no noise.
std::vector<float> levelsOf(std::span<const float> frames, const BlockBackground &block, Index bands, double likeness);

/// Median over the frames of each column of levels.
std::vector<float> mediansOf(const std::vector<float> &levels, Index columns);

/// The part of a sub-band's long-term median level that lines may cause and chance hardly does.
float shareOfLines(float median);

/// Bias of a block's levels, column by column. Levels describe changes within a block, so their median over it should
/// be 0; but the skirts of lines raise means over cells more than the row, which comes from medians over time.
struct LevelOffsets {
    std::vector<float> medians;
    std::vector<bool> isSure; ///< beyond their own deviation: the cells are not exponential (crowded with lines)

    LevelOffsets(const std::vector<float> &levels, Index columns);
};

/// Subtracts offsets from levels: the sure ones of each block, and for others the offsets of sub-bands over a dozen
/// blocks, as far as lines may cause them.
void removeOffsets(std::vector<float> &levels, const std::vector<LevelOffsets> &offsets,
                   const std::vector<Index> &blockOfLevel);

/// Reference of each block's measurement: ln powers smoothed over frequency, and which cells are noise (blocks ×
/// cells).
struct BlockRows {
    std::vector<float> lnPower;
    std::vector<bool> isNoise;
};

/// Converts levels relative to their own block's row to levels relative to the averaged and interpolated background.
void moveToBackground(std::vector<float> &levels, const BlockRows &rows, const NoiseBackground &background,
                      const std::vector<Index> &blockOfLevel);

/// Mean difference of two rows of ln powers over the noise cells of each of `bands` sub-bands and, last, of the whole
/// band.
std::vector<double> meanOver(const float *upper, const float *lower, std::vector<bool>::const_iterator isNoise,
                             Index cells, Index bands);

/// Reduces measured levels to the significant ones, per sub-band: the common level beyond its errors, plus the
/// sub-band's own deviation.
std::vector<float> finishLevels(const std::vector<float> &levels, const NoiseBackground &background, double overlap,
                                double likeness);

} // namespace faintline
