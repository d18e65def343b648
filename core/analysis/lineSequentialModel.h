#pragma once

#include "analysis/AnalysisSettings.h"
#include "model/SequentialModel.h"
#include "spectrum/NormalisedFrames.h"

#include <string>

namespace faintline {

/// The sequential test's model of a line in frames on a frequency axis, or on a part of it: the slopes of the settings,
/// made to lose nothing at the edge slopes and at the ends of the axis.
///
/// Of windows that overlap, one frame in k_t counts (`observedEvery`): those between share samples with it, and α and β
/// hold for independent stages only. Were all taken, two neighbouring Hann frames alone would make E0[e^{λ1+λ2}] = 1/(1
/// - |ρ|²) (exponential likelihood, SNR 1; ρ: correlation of their amplitudes), 1.03 at k_t = 2 and 1.77 at k_t = 4,
/// instead of 1, and from stage to stage more. What is assumed besides: a background that is right, and a line that is
/// there from the first frame on and moves as the model says, over whose paths β is a mean.
///
/// `grid` may be a part of the frames'. Throws Error for sonar's motions, and for a likelihood that is not one of noise
/// power.
SequentialModel lineSequentialModel(const ModelSettings &settings, const Grid &grid, const NormalisedFrames &frames);

/// Frames from one to the next that shares no sample with it: k_t of a spectrogram, 1 of ready-made frames.
Index framesApart(const NormalisedFrames &frames);

/// Throws Error naming `where` if e^λ is no likelihood ratio on exponential noise: E0 e^λ = 1 for rice and exponential;
/// linear has none.
void checkLikelihoodRatio(const Likelihood &likelihood, const std::string &where);

} // namespace faintline
