#pragma once

#include "evaluate/experiments/Campaign.h"
#include "evaluate/experiments/Chart.h"

#include <vector>

namespace faintline {

/// What one value of a sweep came to.
struct SweepPoint {
    double value = 0.0;
    std::int64_t trials = 0;
    std::int64_t detections = 0;
    double pd = 0.0;
    Interval pdInterval; ///< Wilson's
    std::int64_t falseAlarms = 0;
    double hours = 0.0; ///< looked at
    double falseAlarmsPerHour = 0.0;
    Interval falseAlarmInterval; ///< Garwood's, of the count, per hour
    double latencySeconds = 0.0; ///< mean of those detected, 0 where none was
    Interval latencyInterval;    ///< ± 1.96 standard errors
    double threshold = 0.0;
};

/// The values of a sweep's campaign that have runs, in their order. Precondition: the experiment is a sweep.
std::vector<SweepPoint> sweepCurve(const Campaign &campaign);

enum class SweepMeasure { Pd, FalseAlarms, Latency };

/// One measure against the parameter, with its 95 % intervals. Where no false alarm was counted the point stands at 0.7
/// of one, the median of what that leaves open.
Chart sweepChart(const Campaign &campaign, SweepMeasure measure);

/// Pd against false alarms per hour, one point per value, in the order of the values.
Chart tradeOffChart(const Campaign &campaign);

/// Processor seconds for an hour of recording against the parameter.
Chart costChart(const SweepExperiment &experiment, const std::vector<double> &seconds);

} // namespace faintline
