#pragma once

#include "base/RunContext.h"
#include "calibrate/CalibrationEffort.h"
#include "frames/NormalisedFrames.h"
#include "plan/Calibration.h"

#include <functional>
#include <memory>

namespace faintline {

/// Noise for calibration, in segments that can be generated independently.
struct NoiseSegments {
    std::function<NormalisedFramesPointer(int segment)> segment;
    int count = 0;
};

/// The same segments, with those of the first rough pass, which are used repeatedly, generated once.
NoiseSegments rememberedSegments(NoiseSegments noise);

/// Calibrates on noise: K, then the tail, roughly and by splitting, then events.
std::shared_ptr<const Calibration> calibrateOn(const NoiseSegments &noise, const MarkovModel &model,
                                               const AnalysisSettings &settings, const CalibrationEffort &effort,
                                               const RunContext &context);

} // namespace faintline
