#pragma once

#include "base/Interval.h"
#include "evaluate/experiments/LineExperiment.h"
#include "evaluate/experiments/RunOutcome.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace faintline {

/// An estimated detection probability.
struct PdPoint {
    double snrDb = 0.0;
    double pd = 0.0;
    Interval interval;
    std::int64_t trials = 0; ///< number of signals
};

/// Billon's estimate at a mean of one false alarm per noise block (2005, section 5):
///
///   Pd = (1/I²) Σᵢ Σⱼ [ D₁ᵢ > D₀ⱼ ]   per run, averaged over the runs; strictly greater
///
/// D₁ᵢ is the largest statistic on signal i, D₀ⱼ that of noise block j: each block's maximum serves as threshold once.
/// The interval is computed from the scatter of the runs (with fewer than five runs, Wilson's for the signals).
PdPoint pdAgainstBlocks(const LineExperiment &experiment, std::span<const RunOutcome> outcomes, std::size_t detector,
                        std::size_t snr);

/// The threshold that a noise block exceeds with the given probability: a quantile of all blocks' maxima.
double blockThreshold(std::span<const RunOutcome> outcomes, std::size_t detector, double probability);

/// One point of a receiver operating characteristic.
struct RocPoint {
    double threshold = 0.0;
    double falseAlarms = 0.0; ///< mean number per block, -ln P(no block exceeds); of an injection, P(path exceeds)
    double pd = 0.0;
    Interval interval;
};

/// Pd against false alarms for a decreasing threshold, one point per distinct maximum of a noise block; ascending in
/// false alarms.
std::vector<RocPoint> rocCurve(const LineExperiment &experiment, std::span<const RunOutcome> outcomes,
                               std::size_t detector, std::size_t snr);

} // namespace faintline
