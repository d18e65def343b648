#pragma once

#include "analysis/Calibration.h"
#include "analysis/CalibrationEffort.h"
#include "base/RunContext.h"
#include "model/MarkovModel.h"
#include "spectrum/NormalisedFrames.h"

#include <functional>
#include <memory>

namespace faintline {

/// Noise to calibrate on, in segments that can be made independently of each other.
struct NoiseSegments {
    std::function<NormalisedFramesPointer(int segment)> segment;
    int count = 0;
};

/// The same segments, of which those of the rough look, gone through again and again, are made once.
NoiseSegments rememberedSegments(NoiseSegments noise);

/// A calibration on noise: K, then the tail, roughly and by splitting, then events.
std::shared_ptr<const Calibration> calibrateOn(const NoiseSegments &noise, const MarkovModel &model,
                                               const AnalysisSettings &settings, const CalibrationEffort &effort,
                                               const RunContext &context);

} // namespace faintline
