#pragma once

#include "detect/Sprt.h"
#include "frames/NormalisedFrames.h"
#include "plan/AnalysisSettings.h"

#include <string>

namespace faintline {

/// The sequential test's model of a line in frames on a frequency axis, or on a part of it: the slopes of the settings,
/// made lossless at the edge slopes and at the ends of the axis.
///
/// With overlapping windows, one frame in k_t is used (`observedEvery`): the frames between share samples with it, and
/// α and β hold for independent stages only. Otherwise two neighbouring Hann frames alone would give E0[e^{λ1+λ2}] =
/// 1/(1 - |ρ|²) (exponential likelihood, SNR 1; ρ: correlation of their amplitudes), 1.03 at k_t = 2 and 1.77 at k_t =
/// 4, instead of 1, and more from stage to stage. It also assumes a correct background and a line that is present from
/// the first frame on and moves according to the model; β is a mean over its paths.
///
/// `grid` may be a part of the frames' grid. Throws Error for sonar motions, and for likelihoods that are not of noise
/// power.
SequentialModel lineSequentialModel(const ModelSettings &settings, const Grid &grid, const NormalisedFrames &frames);

/// Distance of frames that share no samples: k_t of a spectrogram, 1 for ready-made frames.
Index framesApart(const NormalisedFrames &frames);

/// Ready-made or recorded frames as stages, from a frame on; on a frequency axis a range of its cells.
StageSource stagesOf(NormalisedFramesPointer frames, Index firstFrame, Index firstCell, Index cellCount);

/// Throws Error naming `where` if e^λ is not a likelihood ratio on exponential noise: E0 e^λ = 1 for rice,
/// exponential and swerling4, but not for linear.
void checkLikelihoodRatio(const Likelihood &likelihood, const std::string &where);

} // namespace faintline
