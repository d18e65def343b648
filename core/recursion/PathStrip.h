#pragma once

#include "base/Grid.h"

#include <limits>
#include <vector>

namespace faintline {

/// y in the cells around a path along one axis: input of the second pass over a completed track.
struct PathStrip {
    Index firstFrame = 0;
    Index halfWidth = 0;        ///< cells on either side of the path
    std::vector<Index> centres; ///< the path, one cell per frame
    std::vector<float> y;       ///< frames × width; NaN off the axis and where not observed
    std::vector<float> floor;   ///< by which y was divided at the path, one per frame; empty: 1

    Index width() const { return 2 * halfWidth + 1; }
    Index frameCount() const { return Index(centres.size()); }
    Index firstCell(Index at) const { return centres[std::size_t(at)] - halfWidth; }
    float *row(Index at) { return y.data() + at * width(); }

    /// y of a cell in frame number `at` of the strip; NaN outside the strip.
    float valueAt(Index at, Index cell) const
    {
        const Index i = cell - firstCell(at);
        return i < 0 || i >= width() ? std::numeric_limits<float>::quiet_NaN() : y[std::size_t(at * width() + i)];
    }
};

} // namespace faintline
