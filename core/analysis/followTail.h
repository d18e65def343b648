#pragma once

#include "analysis/Analysis.h"
#include "analysis/CalibrationEffort.h"
#include "analysis/rareRates.h"
#include "base/RunContext.h"

#include <optional>

namespace faintline {

// Splitting on noise like that of a calibration.

/// How rare excursions of noise of known level are, on a small band that closes on itself, along which all cells are
/// alike. The plan has a model, frames like those of the noise, and the calibration's K.
RareRates followTail(const AnalysisPlan &plan, const CalibrationEffort &effort, const RunContext &context);

/// As `followTail`, in so many bins with two ends, or, where their number is not given, in a band that closes on
/// itself.
RareRates followBand(const AnalysisSettings &bare, double lnK, std::optional<Index> bins,
                     const SplittingSettings &splitting, const RunContext &context);

} // namespace faintline
