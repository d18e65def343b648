#pragma once

#include "base/Interval.h"
#include "evaluate/experiments/Campaign.h"
#include "evaluate/experiments/PdCurve.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// One point of a detection-probability curve.
struct CurvePoint {
    std::string detector;
    double snrDb = 0.0;
    double pd = 0.0;
    Interval interval;
    std::int64_t trials = 0;
    std::optional<double> threshold; ///< `shownThreshold`; nothing in a file that does not tell
};

/// The curves of a campaign, detector by detector, in the order of its SNRs.
std::vector<CurvePoint> pdCurve(const Campaign &campaign);

/// The operating characteristic of a detector at one SNR, ascending in false alarms: per block, or, for lines injected
/// into a recording, the probability that the path without the line exceeds. Nothing for a sweep.
std::vector<RocPoint> rocPoints(const Campaign &campaign, std::size_t detector, std::size_t snr);

/// The threshold of a detector: the calibrated one, or, if each block's maximum serves as threshold in turn, that of one
/// false alarm per block on average (exceeded by a fraction 1 - 1/e of the blocks).
double shownThreshold(const Campaign &campaign, std::size_t detector);

} // namespace faintline
