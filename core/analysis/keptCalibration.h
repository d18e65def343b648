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

/// The settings that the answer to noise depends on.
AnalysisSettings dimensionless(AnalysisSettings settings);

std::string calibrationKey(const AnalysisSettings &bare, CalibrationDepth depth);

/// What is known under a key, or else what `make` answers, which is kept. Of the threads and programs that want the
/// same at a time, one makes it and the others wait for it: threads as long as it takes, programs up to two minutes.
/// Null only where `make` answers that. Throws what `make`
/// throws, and Cancelled.
std::shared_ptr<const Calibration> keptCalibration(const std::string &key,
                                                   const std::function<std::shared_ptr<const Calibration>()> &make,
                                                   const RunContext &context);

} // namespace faintline
