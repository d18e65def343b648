#pragma once

#include "base/Grid.h"

#include <string>
#include <vector>

namespace faintline {

/// Names of a position's coordinates in CSV and JSON files: f for a spectrum, else those of the axes.
std::vector<std::string> positionNames(const Grid &grid);

} // namespace faintline
