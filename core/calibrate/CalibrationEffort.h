#pragma once

#include "calibrate/CalibrationDepth.h"
#include "calibrate/measureRareRates.h"

#include <limits>

namespace faintline {

/// Limits on the cost of a calibration.
struct CalibrationEffort {
    double cellFrames = 0.0; ///< amount of noise in which events are counted, of a recording
    /// Number of events, at the threshold where they do not crowd each other out, after which counting stops if the tail
    /// is known from splitting: its own error is larger than theirs.
    double enoughEvents = std::numeric_limits<double>::infinity();
    SplittingSettings splitting{};
    int splittingWindowSamples = 32; ///< for the band in which splitting runs
    bool isFirstEstimate = false;
    double ofIndependentCells = 1.0; ///< fraction of the amount that their request specifies
};

CalibrationEffort effortOf(CalibrationDepth depth);

/// That of the shipped calibrations, which are made once for all.
CalibrationEffort thoroughEffort();

} // namespace faintline
