#pragma once

#include "base/Axis.h"
#include "frames/PeakPyramid.h"

#include <functional>
#include <memory>

namespace faintline {

/// Pictures of a recording while it is still being analysed.
struct PicturesSoFar {
    std::shared_ptr<const PeakPyramid> quickLook; ///< y in dB at some times of the whole recording
    std::shared_ptr<const PeakPyramid> input;     ///< y in dB up to the current frame; null before the chain starts
    std::shared_ptr<const PeakPyramid> statistic; ///< D in nats, likewise
    Axis time;                                    ///< of all frames
    Axis frequency;
};

/// Called by the computing thread a few times per second. It does not change any result.
using PictureSink = std::function<void(const PicturesSoFar &)>;

} // namespace faintline
