#pragma once

#include "plan/AnalysisPlan.h"
#include "plan/constants.h"

namespace faintline {

/// The statistic, in nats, above which a track is about a hundred times rarer on noise than specified.
inline double sureStatistic(const AnalysisPlan &analysis)
{
    return analysis.threshold + sureMarginNats;
}

} // namespace faintline
