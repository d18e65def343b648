#pragma once

#include "base/Axis.h"
#include "spectrum/PeakPyramid.h"

#include <functional>
#include <memory>

namespace faintline {

/// What is there to be seen of a long recording before all of it has been gone through.
struct PicturesSoFar {
    std::shared_ptr<const PeakPyramid> quickLook; ///< y in dB at some times of the whole recording
    std::shared_ptr<const PeakPyramid> input;     ///< y in dB as far as the chain got; null before it starts
    std::shared_ptr<const PeakPyramid> statistic; ///< D in nats, likewise
    Axis time;                                    ///< of all frames
    Axis frequency;
};

/// Called by the thread that computes, a few times a second, if the recording is long or not calibrated yet. Changes no
/// byte.
using PictureSink = std::function<void(const PicturesSoFar &)>;

} // namespace faintline
