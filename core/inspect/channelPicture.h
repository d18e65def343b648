#pragma once

#include "base/RunContext.h"
#include "frames/PeakPyramid.h"
#include "plan/AnalysisSettings.h"
#include "signal/Recording.h"

#include <memory>

namespace faintline {

/// One channel of a recording: y in dB, power over that channel's own noise, on the axes of its spectrogram.
struct ChannelPicture {
    std::shared_ptr<const PeakPyramid> picture;
    Axis frequency; ///< Hz
};

/// The input of an analysis of that channel alone, without a family and with all lines: as `analyse` would draw it
/// within the byte budget, without running a detector. Cost: the noise estimate and one reading. Throws Error if the
/// channel holds no usable sample, Cancelled. Oracle: the input of such an analysis.
ChannelPicture channelPicture(const RecordingPointer &recording, const AnalysisSettings &settings, int channel,
                              std::size_t byteBudget, const RunContext &context = {});

} // namespace faintline
