#include "evaluate/experiments/measuredThreshold.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace faintline {

double measuredThreshold(std::vector<float> maxima, double falseAlarms, const Calibration &calibration,
                         double eventsPerCellFrame)
{
    constexpr double countedAlarmsMinimum = 10.0;
    const auto blocks = double(maxima.size());
    const double counted = std::max(falseAlarms, std::min(countedAlarmsMinimum, 0.5 * blocks));
    const auto exceeding = std::size_t(std::llround(blocks * -std::expm1(-counted / blocks)));
    std::sort(maxima.begin(), maxima.end(), std::greater<>());
    const double calibrated = calibration.thresholdForEventRate(eventsPerCellFrame);
    if (exceeding == 0 || exceeding >= maxima.size() || !std::isfinite(maxima[exceeding]))
        return calibrated;
    const double measured = 0.5 * (double(maxima[exceeding - 1]) + double(maxima[exceeding]));
    return measured + calibrated - calibration.thresholdForEventRate(eventsPerCellFrame * counted / falseAlarms);
}

} // namespace faintline
