#pragma once

#include "analysis/Analysis.h"
#include "base/RunContext.h"

namespace faintline {

/// Fills in frames and background of a plan with settings, of a spectrogram of its recording. Throws Error where
/// nothing of it can be used, Cancelled.
void normalisePlan(AnalysisPlan &plan, std::shared_ptr<const Spectrogram> spectrogram, const RunContext &context = {});

/// Fills in the model, its calibration and the threshold of a plan that has its frames.
void calibratePlan(AnalysisPlan &plan, const RunContext &context = {},
                   CalibrationDepth depth = CalibrationDepth::Refined);

/// The frames of single lines that a family is looked for in, of all channels together; the plan's own where there is
/// no family. Precondition: of a family, frames of a spectrogram.
NormalisedFramesPointer framesOfLines(const AnalysisPlan &plan);

} // namespace faintline
