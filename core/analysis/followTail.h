#pragma once

#include "analysis/AnalysisSettings.h"
#include "analysis/CalibrationEffort.h"
#include "analysis/rareRates.h"
#include "base/RunContext.h"
#include "spectrum/NormalisedFrames.h"

namespace faintline {

// Splitting on noise like that of a calibration.

/// How rare excursions of noise of known level are, on a small band that closes on itself, along which all cells are
/// alike.
RareRates followTail(const NormalisedFrames &frames, const MarkovModel &model, const AnalysisSettings &settings,
                     const Calibration &calibration, const CalibrationEffort &effort, const RunContext &context);

/// As `followTail`, in `bins` bins with two ends, or in a band that closes on itself.
RareRates followBand(const AnalysisSettings &bare, double lnK, Index bins, bool isCyclic,
                     const SplittingSettings &splitting, const RunContext &context);

} // namespace faintline
