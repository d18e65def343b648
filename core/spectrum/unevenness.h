#pragma once

#include "base/Axis.h"
#include "spectrum/blockBackground.h"

#include <span>
#include <vector>

namespace faintline {

/// How much tiles of 8 frames × 24 cells change with time.
struct Unevenness {
    double sum = 0.0;        ///< of squared deviations of ln(mean of a tile) from its cells' mean over all time
    double sumOfMeans = 0.0; ///< of the means' themselves, which a few tiles far too high decide
    double freedom = 0.0;    ///< how many of them are independent

    double variance() const { return freedom > 0.0 ? sum / freedom : 0.0; }
    double varianceOfMeans() const { return freedom > 0.0 ? sumOfMeans / freedom : 0.0; }
    /// That of steady noise, whose neighbouring cells are alike by the window.
    static double ofNoise(double likeness) { return likeness / double(tileFrames * tileCells); }

    static constexpr Index tileFrames = 8;
    static constexpr Index tileCells = 24;
};

/// Of frames (frames × cells) times a factor for each cell and one for each frame; strong lines cut off.
Unevenness unevenness(std::span<const float> frames, const std::vector<float> &ofCell,
                      const std::vector<float> &ofFrame);

/// How the colour changes in a block: of its frames over its row and the common level.
Unevenness changesOf(const std::vector<float> &frames, const BlockBackground &block, const std::vector<float> &levels,
                     Index bands);

} // namespace faintline
