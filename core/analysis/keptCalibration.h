#pragma once

#include "analysis/Calibration.h"
#include "base/RunContext.h"

#include <functional>
#include <memory>
#include <string>

namespace faintline {

// Under which name a calibration is kept, and what was kept.

inline constexpr int calibrationWindowSamples = 256; ///< of the simulated recording; its noise does not depend on it

/// How the chain decides, independent of the threshold.
DecideSettings withoutThreshold(DecideSettings decide);

/// The settings that the answer to noise depends on; of channels, how many there are.
AnalysisSettings dimensionless(AnalysisSettings settings);

std::string calibrationKey(const AnalysisSettings &bare, CalibrationDepth depth);

/// The calibration kept under a key, or else the result of `make`, which is kept. If several threads and programs need
/// the same one at the same time, one makes it and the others wait: threads without limit, programs up to two minutes.
/// Null only if `make` returns null. Throws what `make` throws, and Cancelled.
std::shared_ptr<const Calibration> keptCalibration(const std::string &key,
                                                   const std::function<std::shared_ptr<const Calibration>()> &make,
                                                   const RunContext &context);

} // namespace faintline
