#pragma once

#include "base/RunContext.h"
#include "calibration/CalibrationDepth.h"
#include "plan/Calibration.h"

#include <functional>
#include <memory>
#include <string>

namespace faintline {

// Cache of calibrations and its keys.

inline constexpr int calibrationWindowSamples = 256; ///< of the simulated recording; noise is independent of it

/// How the chain decides, independent of the threshold.
DecideSettings withoutThreshold(DecideSettings decide);

/// The settings on which the response to noise depends; for channels, their number.
AnalysisSettings dimensionless(AnalysisSettings settings);

std::string calibrationKey(const AnalysisSettings &bare, CalibrationDepth depth);

/// The calibration cached under a key, or else the result of `make`, which is then cached. If several threads and
/// programs need the same one at the same time, one makes it and the others wait: threads without limit, programs up to
/// two minutes. Null only if `make` returns null. Throws what `make` throws, and Cancelled.
std::shared_ptr<const Calibration> keptCalibration(const std::string &key,
                                                   const std::function<std::shared_ptr<const Calibration>()> &make,
                                                   const RunContext &context);

} // namespace faintline
