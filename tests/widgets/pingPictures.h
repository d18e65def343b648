#pragma once

#include "frames/pictureCuts.h"

#include <memory>
#include <vector>

namespace faintline::test {

constexpr Index ranges = 50;
constexpr Index beams = 8;
inline const Axis rangeAxis{"range", "m", 1000.0, 10.0, ranges, false};
inline const Axis bearingAxis{"bearing", "°", 0.0, 45.0, beams, true};

/// A ping of 1 nat in every cell but this one, and as many before and behind it along its bearing, so that a pixel lies
/// within them.
inline std::shared_ptr<const PeakPyramid> pingPicture(Index range, Index beam, Index reach = 0,
                                                      const Axis &bearings = bearingAxis)
{
    std::vector<float> values(std::size_t(ranges * bearings.count), 1.0f);
    for (Index near = range - reach; near <= range + reach; ++near)
        values[std::size_t(near * bearings.count + beam)] = 30.0f;
    return pictureOf(rangeAxis, bearings, values, ByteScale(ByteScale::Kind::ScoreNats));
}

} // namespace faintline::test
