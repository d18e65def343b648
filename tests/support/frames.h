#pragma once

#include "frames/NormalisedFrames.h"

#include <memory>
#include <utility>
#include <vector>

namespace faintline::test {

/// y over time from 0 s and frequency from 100 Hz on, row by row of `cells` values.
inline std::shared_ptr<const FrameArray> framesOf(Index cells, std::vector<float> y, double stepSeconds = 1.0,
                                                  double stepHz = 1.0)
{
    const Index count = std::ssize(y) / cells;
    return std::make_shared<FrameArray>(Axis{"time", "s", 0.0, stepSeconds, count, false},
                                        Grid{{{"frequency", "Hz", 100.0, stepHz, cells, false}}}, std::move(y));
}

} // namespace faintline::test
