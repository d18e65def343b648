#pragma once

#include "detect/makeDetector.h"

namespace faintline {

/// Number of decimals of a displayed statistic: a hundredth matters for noise power, not for a nat.
inline int statisticDecimals(const DetectorSettings &settings)
{
    return statisticUnit(settings) == "nat" ? 1 : 2;
}

} // namespace faintline
