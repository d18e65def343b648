#pragma once

#include "base/Interval.h"
#include "evaluate/experiments/Campaign.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// One point of a detection-probability curve.
struct CurvePoint {
    std::string detector;
    double snrDb = 0.0;
    double pd = 0.0;
    Interval interval;
    std::int64_t trials = 0;         ///< number of signals
    std::optional<double> threshold; ///< `shownThreshold`; nothing in a file that does not tell
};

/// The curves of a campaign, detector by detector, in the order of its SNRs. Lines in simulated noise are counted by
/// `pdAgainstBlocks`, injected ones by `pdAbove` the detector's threshold.
std::vector<CurvePoint> pdCurve(const Campaign &campaign);

/// Billon's estimate at a mean of one false alarm per noise block (2005, section 5):
///
///   Pd = (1/I²) Σᵢ Σⱼ [ D₁ᵢ > D₀ⱼ ]   per run, averaged over the runs; strictly greater
///
/// D₁ᵢ is the largest statistic on signal i, D₀ⱼ that of noise block j: each block's maximum serves as threshold once.
/// The interval is computed from the scatter of the runs (with fewer than five runs, Wilson's for the signals). The
/// point has neither name nor threshold.
CurvePoint pdAgainstBlocks(const Experiment &experiment, std::span<const RunOutcome> outcomes, std::size_t detector,
                           std::size_t snr);

/// The share of a detector's signals above a threshold. The point has no name. Precondition: there are runs.
CurvePoint pdAbove(const Campaign &campaign, std::size_t detector, std::size_t snr, double threshold);

/// The threshold that a noise block exceeds with the given probability: a quantile of all blocks' maxima.
double blockThreshold(std::span<const RunOutcome> outcomes, std::size_t detector, double probability);

/// The threshold of a detector: the calibrated one, or, if each block's maximum serves as threshold in turn, that of one
/// false alarm per block on average (exceeded by a fraction 1 - 1/e of the blocks).
double shownThreshold(const Campaign &campaign, std::size_t detector);

/// One point of a receiver operating characteristic.
struct RocPoint {
    double threshold = 0.0;
    double falseAlarms = 0.0; ///< mean number per block, -ln P(no block exceeds); of an injection, P(path exceeds)
    double pd = 0.0;
    Interval interval;
};

/// Pd of a detector against false alarms for a decreasing threshold, one point per distinct maximum of a noise block, or,
/// for lines injected into a recording, of a path without its line; ascending in false alarms. Nothing for a sweep.
std::vector<RocPoint> rocPoints(const Campaign &campaign, std::size_t detector, std::size_t snr);

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

} // namespace faintline
