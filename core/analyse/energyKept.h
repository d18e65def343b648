#pragma once

#include "base/Axis.h"
#include "track/Track.h"

#include <span>

namespace faintline {

/// Smoothed tracks of one analysis, and the axes that convert their points to seconds and hertz.
struct TracksOnAxes {
    std::span<const Track> tracks; ///< with one smoothed point per point
    const Axis &time;
    const Axis &frequency;
    double cellHz = 0.0; ///< resolution 1/T_FT
};

/// Fraction of the energy followed by tracks of a shorter window that tracks of a longer window followed at the same
/// places:
///
///   E(X) = Σ r(t) over all tracks within X's path ± 1 cell of the shorter window, in X's time
///   share = E_longer(X)/E_shorter(X)
///
/// r is a signal's power over the noise's in one frame. Both sides have the same number of frames per window, so a
/// steady line has the same E in both: its r grows with T_FT as the number of frames falls. The power of a line that
/// moves by more than a cell within the longer window spreads over several cells, of which a path follows one. Returns
/// the median, weighted by duration, over the tracks X of at least `leastStatistic` that the longer window detected at
/// all; NaN without such tracks.
double energyKept(const TracksOnAxes &shorter, const TracksOnAxes &longer, double leastStatistic);

} // namespace faintline
