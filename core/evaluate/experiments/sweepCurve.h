#pragma once

#include "evaluate/experiments/Campaign.h"
#include "evaluate/experiments/Chart.h"

#include <vector>

namespace faintline {

/// Result for one value of a sweep.
struct SweepPoint {
    double value = 0.0;
    std::int64_t trials = 0;
    std::int64_t detections = 0;
    double pd = 0.0;
    Interval pdInterval; ///< Wilson's
    std::int64_t falseAlarms = 0;
    double hours = 0.0; ///< observed time
    double falseAlarmsPerHour = 0.0;
    Interval falseAlarmInterval; ///< Garwood's, for the count, per hour
    double latencySeconds = 0.0; ///< mean over detected lines, 0 if none
    Interval latencyInterval;    ///< ± 1.96 standard errors
    double threshold = 0.0;
};

/// The values of a sweep's campaign that have runs, in their order. Precondition: the experiment is a sweep.
std::vector<SweepPoint> sweepCurve(const Campaign &campaign);

enum class SweepMeasure { Pd, FalseAlarms, Latency };

/// One measure against the parameter, with its 95 % intervals. Where no false alarm was counted the point is drawn at
/// 0.7 of one, the median of the remaining possibilities.
Chart sweepChart(const Campaign &campaign, SweepMeasure measure);

/// Pd against false alarms per hour, one point per value, in the order of the values.
Chart tradeOffChart(const Campaign &campaign);

/// Processor seconds per hour of recording against the parameter.
Chart costChart(const SweepExperiment &experiment, const std::vector<double> &seconds);

} // namespace faintline
