#include "scene/legRates.h"

namespace faintline {

LegRates ratesOf(const PingLeg &leg, double priSeconds, const Grid &grid)
{
    return {leg.rangeCellsPerPing + leg.rangeRateMetresPerSecond * priSeconds / grid.axes[0].step,
            leg.beamsPerPing + leg.bearingRateDegreesPerSecond * priSeconds / grid.axes[1].step,
            leg.elevationRateDegreesPerSecond * priSeconds};
}

} // namespace faintline
