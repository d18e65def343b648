#pragma once

#include "base/Grid.h"

#include <limits>
#include <vector>

namespace faintline {

/// y in the cells around a path along one axis: the data of the second pass when a track is complete.
struct PathStrip {
    Index firstFrame = 0;
    Index halfWidth = 0;        ///< cells on either side of the path
    std::vector<Index> centres; ///< the path, one cell a frame
    std::vector<float> y;       ///< frames × width, NaN off the axis and where nothing was observed

    Index width() const { return 2 * halfWidth + 1; }
    Index frameCount() const { return Index(centres.size()); }
    Index firstCell(Index at) const { return centres[std::size_t(at)] - halfWidth; }
    float *row(Index at) { return y.data() + at * width(); }

    /// y of the cell at a position in frame number `at` of the strip, NaN outside of it.
    float valueAt(Index at, Index cell) const
    {
        const Index i = cell - firstCell(at);
        return i < 0 || i >= width() ? std::numeric_limits<float>::quiet_NaN() : y[std::size_t(at * width() + i)];
    }
};

} // namespace faintline
