#pragma once

#include "base/RunContext.h"
#include "calibrate/calibrate.h"
#include "plan/AnalysisPlan.h"

namespace faintline {

/// Sets frames and background of a plan with settings, from a spectrogram of its recording. Throws Error if no part of
/// it is usable, Cancelled.
void normalisePlan(AnalysisPlan &plan, std::shared_ptr<const Spectrogram> spectrogram, const RunContext &context = {});

/// Sets the model, its calibration and the threshold of a plan that has its frames.
void calibratePlan(AnalysisPlan &plan, const RunContext &context = {},
                   CalibrationDepth depth = CalibrationDepth::Refined);

/// The frames of single lines, of all channels together, in which a family is searched for; of ready-made frames, these.
NormalisedFramesPointer framesOfLines(const AnalysisPlan &plan);

} // namespace faintline
