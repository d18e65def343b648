#pragma once

#include "track/HmmTracker.h"
#include "track/PlaceIndex.h"

#include <vector>

namespace faintline {

// Trackers beside each other: each follows a signal of its own.

/// Cells that belong to another place than number `own`, because they are nearer to it: hidden from the tracker there,
/// they prevent it from moving over to a stronger signal that another one follows. The cells of boxes of `halfWidth`,
/// per axis, around the places at most `farthest` away; a cell may occur more than once. Distance: the largest along
/// any axis, in cells.
std::vector<Index> cellsOfNeighbours(const Grid &grid, const PlaceIndex &places, std::size_t own, Index farthest,
                                     const std::vector<Index> &halfWidth);

/// Removes the younger one of two trackers that follow one signal: those that have been within `linkCells` of each
/// other, per axis, for three frames in succession. Returns the tracks of those removed that had existed separately for
/// longer than beside the other; the rest were second reports of the same signal. `trackers`: the oldest first.
std::vector<Track> endedDuplicates(std::vector<HmmTracker> &trackers, const Grid &grid,
                                   const std::vector<Index> &linkCells);

} // namespace faintline
