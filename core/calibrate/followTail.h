#pragma once

#include "base/RunContext.h"
#include "calibrate/CalibrationEffort.h"
#include "calibrate/measureRareRates.h"
#include "plan/AnalysisPlan.h"

namespace faintline {

// Splitting on noise like that of a calibration.

/// Rates of rare excursions on noise of known level, in a small cyclic band in which all cells are equivalent. The plan
/// has a model, frames like those of the noise, and the calibration's K.
RareRates followTail(const AnalysisPlan &plan, const CalibrationEffort &effort, const RunContext &context);

/// As `followTail`, in `bins` bins with two ends.
RareRates followBand(const AnalysisSettings &bare, double lnK, Index bins, const SplittingSettings &splitting,
                     const RunContext &context);

} // namespace faintline
