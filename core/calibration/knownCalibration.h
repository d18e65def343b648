#pragma once

#include "plan/Calibration.h"

namespace faintline {

/// The refined calibration that `calibrate` has cached for these settings, in memory or on disk, or null; for callers
/// that would rather do something else than wait.
std::shared_ptr<const Calibration> knownCalibration(const AnalysisSettings &settings);

} // namespace faintline
