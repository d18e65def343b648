#pragma once

#include "analysis/Calibration.h"
#include "analysis/rareRates.h"

namespace faintline {

/// What a calibration may cost.
struct CalibrationEffort {
    double cellFrames = 0.0; ///< noise in which events are counted
    SplittingSettings splitting{};
    int pieceWindowSamples = 32; ///< of the band that splitting goes on in
    bool isFirstEstimate = false;
};

CalibrationEffort effortOf(CalibrationDepth depth);

} // namespace faintline
