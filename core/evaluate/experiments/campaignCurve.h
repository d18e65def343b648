#pragma once

#include "base/Interval.h"
#include "evaluate/experiments/Campaign.h"

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
    std::optional<double> threshold; ///< nothing if each noise block's maximum serves as threshold
};

/// The curves of a campaign, detector by detector, in the order of its SNRs.
std::vector<CurvePoint> pdCurve(const Campaign &campaign);

} // namespace faintline
