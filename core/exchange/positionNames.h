#pragma once

#include "base/Grid.h"

#include <string>
#include <vector>

namespace faintline {

/// What a position's coordinates are called in CSV and JSON files: f in a spectrum, else as the axes.
std::vector<std::string> positionNames(const Grid &grid);

} // namespace faintline
