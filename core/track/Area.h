#pragma once

#include "base/Axis.h"

#include <vector>

namespace faintline {

/// A band of cells whose level was raised for a while, without a line in it: a burst, a cloud, a hum, a spread or keyed
/// signal. What the detector found there were paths through it.
struct Area {
    Index firstFrame = 0;
    Index lastFrame = 0;
    Index firstCell = 0; ///< along the last axis
    Index lastCell = 0;
    double level = 1.0; ///< least mean level over the noise's, power

    bool operator==(const Area &) const = default;
};

/// Areas that overlap or touch become one, as long as its box is at most a fifth larger than all that it was joined
/// of: a burst over the whole band and a hum that goes on behind it stay two, and a diagonal stays several. The level
/// is the mean, weighted by their frames. Ordered by first frame, then cell.
std::vector<Area> joinAreas(std::vector<Area> areas);

} // namespace faintline
