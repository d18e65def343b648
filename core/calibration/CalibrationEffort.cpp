#include "calibration/CalibrationEffort.h"

namespace faintline {

CalibrationEffort effortOf(CalibrationDepth depth)
{
    if (depth == CalibrationDepth::Refined)
        return {8e7};
    SplittingSettings fewer;
    fewer.entries = 1000;
    fewer.pilots = 60;
    fewer.leastLnRate = -21.0;
    return {1.6e7, fewer, 16, true};
}

} // namespace faintline
