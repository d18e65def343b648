#include "calibrate/CalibrationEffort.h"

namespace faintline {

CalibrationEffort effortOf(CalibrationDepth depth)
{
    CalibrationEffort effort = thoroughEffort();
    if (depth == CalibrationDepth::Refined) {
        effort.enoughEvents = 100.0;
        return effort;
    }
    effort.cellFrames = 1.6e7;
    effort.splitting.pilots = 60;
    effort.splitting.leastLnRate = -21.0;
    effort.splittingWindowSamples = 16;
    effort.isFirstEstimate = true;
    return effort;
}

CalibrationEffort thoroughEffort()
{
    CalibrationEffort effort;
    effort.cellFrames = 8e7;
    return effort;
}

} // namespace faintline
