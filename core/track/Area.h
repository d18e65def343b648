#pragma once

#include "base/Axis.h"

#include <vector>

namespace faintline {

/// A band of cells whose level was raised for a while, without a line in it: a burst, a cloud, a hum, a spread or keyed
/// signal. The detector found paths through it.
struct Area {
    Index firstFrame = 0;
    Index lastFrame = 0;
    Index firstCell = 0; ///< along the last axis
    Index lastCell = 0;
    double level = 1.0; ///< minimum mean power over the noise's

    bool operator==(const Area &) const = default;
};

/// Joins areas that overlap or touch, as long as the joined box is at most a fifth larger than its parts: a burst over
/// the whole band and a hum that continues after it stay two, and a diagonal stays several. The level is the mean,
/// weighted by frames. Ordered by first frame, then cell.
std::vector<Area> joinAreas(std::vector<Area> areas);

} // namespace faintline
