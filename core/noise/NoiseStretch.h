#pragma once

#include "noise/noiseSources.h"

#include <span>
#include <vector>

namespace faintline {

/// A stretch of time in which the noise changes its colour, as a sum of sources with levels in each frame.
struct NoiseStretch {
    Index firstLevel = 0;            ///< index into the background's level times
    NoiseSources sources;            ///< colours relative to `lnPower`
    std::vector<float> lnPower;      ///< of each cell
    std::vector<float> sourceLevels; ///< level times × sources
    float floor = 0.0f;              ///< ln power of rounding errors

    Index levelCount() const { return sources.count() > 0 ? std::ssize(sourceLevels) / sources.count() : 0; }
};

/// ln power of a stretch's noise in a frame with the given source levels.
void readStretch(const NoiseStretch &stretch, std::span<const float> levels, std::span<float> ln);

} // namespace faintline
