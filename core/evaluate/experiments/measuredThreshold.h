#pragma once

#include "analysis/Calibration.h"

#include <vector>

namespace faintline {

/// A threshold for a number of false alarms that were counted, not reckoned.
///
/// `maxima` holds the largest statistic of every block of a recording without signals, of any detector in its own unit;
/// of N blocks, m exceed a threshold with
///
///   false alarms = -N ln(1 - m/N)
///
/// The threshold lies half way between the two maxima that this divides. Where fewer than ten false alarms are asked
/// for it is found for ten, and moved on by as much as the calibration's thresholds for the two rates differ. Blocks
/// that decide nothing (-∞) exceed no threshold; where there are too few others the calibration's own threshold is all
/// that is known. `eventsPerCellFrame`: what the calibration calls the same rate.
double measuredThreshold(std::vector<float> maxima, double falseAlarms, const Calibration &calibration,
                         double eventsPerCellFrame);

} // namespace faintline
