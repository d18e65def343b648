#pragma once

#include "scene/PingScene.h"

namespace faintline {

/// Rates in cells, beams and degrees of elevation per ping.
struct LegRates {
    double range = 0.0;
    double bearing = 0.0;
    double elevationDegrees = 0.0;
};

/// The rates of a leg; those in physical units and those in cells add up. `grid`: the scene's, as `pingGrid` makes it.
LegRates ratesOf(const PingLeg &leg, double priSeconds, const Grid &grid);

} // namespace faintline
