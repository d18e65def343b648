#pragma once

#include "calibration/CalibrationDepth.h"
#include "calibration/measureRareRates.h"

namespace faintline {

/// Limits on the cost of a calibration.
struct CalibrationEffort {
    double cellFrames = 0.0; ///< amount of noise in which events are counted
    SplittingSettings splitting{};
    int pieceWindowSamples = 32; ///< for the band in which splitting runs
    bool isFirstEstimate = false;
};

CalibrationEffort effortOf(CalibrationDepth depth);

} // namespace faintline
