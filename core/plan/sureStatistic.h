#pragma once

#include "plan/AnalysisPlan.h"

namespace faintline {

/// The statistic, in nats, above which a track is about a hundred times rarer on noise than specified: 3.3 above the
/// threshold, ln 100 over a typical slope of the tail.
inline double sureStatistic(const AnalysisPlan &analysis)
{
    constexpr double margin = 3.3;
    return analysis.threshold + margin;
}

} // namespace faintline
