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

/// All values of frames or pings, in order.
template <class Frames>
std::vector<float> allOf(const Frames &frames)
{
    std::vector<float> values(std::size_t(frames.time().count * frames.grid().size()));
    frames.read(0, frames.time().count, values);
    return values;
}

} // namespace faintline::test
