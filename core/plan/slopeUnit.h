#pragma once

#include "frames/NormalisedFrames.h"
#include "plan/AnalysisSettings.h"

namespace faintline {

/// Slope in Hz/s of one bin per frame for a recording with these settings: bin width over frame interval, about
/// k_t/(k_f·T_FT²). For harmonics: in bins of their fundamental.
double hzPerSecondOfABinAFrame(const AnalysisSettings &settings, const RecordingInfo &info);

/// Converts slopes to another unit. `hzPerSecond`: one bin per frame. In bins per frame they are rounded outward to
/// multiples of 1/slopesPerBin, so that the specified range is covered; in Hz/s they have four digits.
ModelSettings withSlopesIn(SlopeUnit unit, ModelSettings model, double hzPerSecond);

/// The settings with slopes in bins per frame, as computations need them; unchanged if they already are.
AnalysisSettings withSlopesInBins(AnalysisSettings settings, const RecordingInfo &info);
/// The same for ready-made frames, along the last axis.
AnalysisSettings withSlopesInBins(AnalysisSettings settings, const NormalisedFrames &frames);

} // namespace faintline
