#pragma once

#include "base/Axis.h"

#include <vector>

namespace faintline {

// Noise estimate from one block of frames.

/// Upper bound on the ratio of noise cells (medians of `frames` frames) to their neighbours: five standard errors.
double mostNoiseRatio(double frames);

/// Replaces medians by the mean of ratio e^(value-median) over the cells within ±half that are not lines; returns which
/// cells are noise.
std::vector<bool> refine(const std::vector<float> &values, std::vector<float> &medians, Index half, double mostRatio);

/// Noise estimate of one block, cell by cell.
struct BlockBackground {
    std::vector<float> medians; ///< ln of each cell's mean, from its median over time
    std::vector<float> lnPower; ///< ln mean noise power
    std::vector<bool> isNoise;  ///< false if a line persists throughout the block, and if there is only rounding error
    std::vector<bool> isFirm;   ///< noise well above rounding
};

/// What a block of frames (frames × cells) says of each cell. Frames of digital silence do not count.
struct BlockMedians {
    std::vector<float> ofCells; ///< over time; 0 if all is silent
    Index frames = 0;           ///< number of frames that count
    float strongest = 0.0f;     ///< value of all

    BlockMedians(const std::vector<float> &block, Index cells);
};

/// The background of one block of frames.
BlockBackground blockBackground(const BlockMedians &medians, Index half);

/// Scales frames (frames × cells) that are clearly louder or softer than most to one level, so that medians over time
/// give the noise colour independent of its level; returns the change of each frame, ln. The level is that of the
/// median cell relative to the medians over time, from at most 500 cells. Digital silence is not changed. `medians`:
/// those of the frames before, and afterwards.
std::vector<float> flatten(std::vector<float> &frames, Index cells, BlockMedians &medians);

} // namespace faintline
