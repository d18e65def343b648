#pragma once

#include "base/Axis.h"

#include <vector>

namespace faintline {

// What one block of frames says about its noise.

/// Rounding of the single-precision transform, relative to the frame's strongest bin: nothing below it is noise.
inline constexpr double roundingFloor = 1e-13;

/// What cells of noise, medians of this number of frames, never exceed in relation to their neighbours: five standard
/// errors.
double mostNoiseRatio(double frames);

/// Mean of ratio e^(value-median) over the cells within ±half that are not lines; answers which are not.
std::vector<bool> refine(const std::vector<float> &values, std::vector<float> &medians, Index half, double mostRatio);

/// What one block of frames says about its cells.
struct BlockBackground {
    std::vector<float> medians; ///< ln of each cell's mean, from its median over time
    std::vector<float> lnPower; ///< ln mean noise power
    std::vector<bool> isNoise;  ///< false where a line lies all through the block, and where there is but rounding
    std::vector<bool> isFirm;   ///< noise well above rounding
};

/// The background under one block of frames (frames × cells).
BlockBackground blockBackground(const std::vector<float> &frames, Index cells, Index half);

/// Brings frames (frames × cells) that are plainly louder or softer than most to one level, so that medians over time
/// tell the noise's colour independent of its level; answers by how much each was changed, ln. The level is the median
/// cell's over the medians over time, of 500 cells if there are more. Digital silence is left alone.
std::vector<float> flatten(std::vector<float> &frames, Index cells);

} // namespace faintline
