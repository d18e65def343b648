#pragma once

#include "plan/Calibration.h"

#include <vector>

namespace faintline {

/// A threshold for a number of false alarms, from counts rather than a model.
///
/// `maxima` holds the largest statistic of each block of a recording without signals, for any detector in its own unit;
/// of N blocks, m exceed a threshold with
///
///   false alarms = -N ln(1 - m/N)
///
/// The threshold lies half way between the two maxima that this separates. If fewer than ten false alarms are
/// specified, it is determined for ten and shifted by the difference of the calibration's thresholds for the two rates.
/// Blocks that decide nothing (-∞) exceed no threshold; if too few others remain, the calibration's own threshold is
/// used. `eventsPerCellFrame`: the same rate in the calibration's unit.
double measuredThreshold(std::vector<float> maxima, double falseAlarms, const Calibration &calibration,
                         double eventsPerCellFrame);

} // namespace faintline
