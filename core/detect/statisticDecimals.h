#pragma once

#include "detect/makeDetector.h"

namespace faintline {

/// Decimals that a statistic is shown with: a hundredth of the noise's power matters, of a nat it does not.
inline int statisticDecimals(const DetectorSettings &settings)
{
    return statisticUnit(settings) == "nat" ? 1 : 2;
}

} // namespace faintline
