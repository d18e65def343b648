#pragma once

#include "base/Grid.h"
#include "scene/PingTruth.h"
#include "scene/Truth.h"

#include <string>

namespace faintline {

// The truth that lies beside a recording or recorded pings (truthPathOf), in the format that `simulate --truth` writes.

/// The lines of a recording; none if there is no such file. Throws Error naming the file.
Truth truthBeside(const std::string &path);

/// The targets of pings; none if there is no such file, or if `grid` is not one of range and bearing. Throws Error
/// naming the file, also if a cell lies beyond the grid.
PingTruth pingTruthBeside(const std::string &path, const Grid &grid);

} // namespace faintline
