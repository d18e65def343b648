#pragma once

#include "base/Axis.h"
#include "noise/blockBackground.h"

#include <span>
#include <vector>

namespace faintline {

/// Variation over time of tiles of 8 frames × 24 cells.
struct Unevenness {
    double sum = 0.0;        ///< squared deviations of ln(mean of a tile) from its cells' mean over all time
    double sumOfMeans = 0.0; ///< squared deviations of the means themselves, dominated by outliers
    double freedom = 0.0;    ///< degrees of freedom

    double variance() const { return freedom > 0.0 ? sum / freedom : 0.0; }
    double varianceOfMeans() const { return freedom > 0.0 ? sumOfMeans / freedom : 0.0; }
    /// Expected variance for steady noise whose neighbouring cells are correlated by the window.
    static double ofNoise(double likeness) { return likeness / double(tileFrames * tileCells); }

    static constexpr Index tileFrames = 8;
    static constexpr Index tileCells = 24;
};

/// Variation of frames (frames × cells) scaled by a factor per cell and one per frame; strong lines are clipped.
Unevenness unevenness(std::span<const float> frames, const std::vector<float> &ofCell,
                      const std::vector<float> &ofFrame);

/// Colour changes within a block: variation of its frames relative to its row and the common level.
Unevenness changesOf(const std::vector<float> &frames, const BlockBackground &block, const std::vector<float> &levels,
                     Index bands);

} // namespace faintline
