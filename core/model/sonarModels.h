#pragma once

#include "base/Grid.h"
#include "model/MarkovModel.h"

#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// Possible motion of a sonar's targets, in range cells and beams per ping. State: range × bearing × range rate ×
/// bearing rate.
struct SonarMotion {
    int fastestRange = 20;                    ///< range rates -20 … 20
    int fastestBearing = 1;                   ///< bearing rates -1 … 1
    std::vector<double> rangeRateChange{1.0}; ///< h(0), h(1), …
    std::vector<double> bearingRateChange{1.0};
};

/// Targets that keep their rates: each state has one successor, P = 1.
SonarMotion nonManoeuvring();

/// Targets whose range rate changes by up to ± `reach` cells per ping between pings, with equal probability, and whose
/// bearing rate changes by one beam per ping with probability ¼ either way.
SonarMotion manoeuvring(int reach = 4);

/// The model of such targets on a ping's grid of range and bearing. Mean rates are rounded toward zero; the
/// log-likelihood ratio is y itself (Parsons 2008, eq. 10). Memory: 123 states per cell with the default rates. Source:
/// Parsons 2008, section 3 and Table 1. Throws Error if the grid is not range × bearing.
MarkovModel sonarModel(const Grid &grid, const SonarMotion &motion);

/// A motion with a name, for lists and settings.
struct NamedMotion {
    std::string name;
    std::string sentence;
    SonarMotion motion;
};
const std::vector<NamedMotion> &sonarMotions();
const SonarMotion &sonarMotion(std::string_view name);

} // namespace faintline
