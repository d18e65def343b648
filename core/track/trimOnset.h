#pragma once

#include "track/Track.h"

#include <vector>

namespace faintline {

/// Removes the points before a new track's onset. A path usually reaches its signal through some frames of favourable
/// noise. The signal begins where the score begins to grow: the change point between no growth and half the path's own
/// mean growth,
///
///   onset = argmin_i s(i - 1) - i·s(n - 1)/2n,   s(-1) = 0,
///
/// for statistics s(0) … s(n - 1); the first of equals, and 0 if no value is below 0. `points`: not empty.
void trimOnset(std::vector<TrackPoint> &points);

} // namespace faintline
