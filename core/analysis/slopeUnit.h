#pragma once

#include "analysis/AnalysisSettings.h"
#include "recording/Recording.h"
#include "spectrum/NormalisedFrames.h"

namespace faintline {

/// How many Hz/s a slope of one bin a frame is where a recording is cut so: bin width over time from frame to frame,
/// about k_t/(k_f·T_FT²).
/// Of harmonics: of their fundamental's bins.
double hzPerSecondOfABinAFrame(const AnalysisSettings &settings, const RecordingInfo &info);

/// The same slopes in another unit. `hzPerSecond`: of one bin a frame. In bins a frame they lie on the set of multiples
/// of 1/slopesPerBin, taken outwards, so that what may occur is among them; in Hz/s they have four digits.
ModelSettings withSlopesIn(SlopeUnit unit, ModelSettings model, double hzPerSecond);

/// The settings with slopes in bins a frame, as all that computes with them wants them: unchanged where they are so.
AnalysisSettings withSlopesInBins(AnalysisSettings settings, const RecordingInfo &info);
/// The same for frames that are there already, along the last axis.
AnalysisSettings withSlopesInBins(AnalysisSettings settings, const NormalisedFrames &frames);

} // namespace faintline
