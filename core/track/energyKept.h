#pragma once

#include "base/Axis.h"
#include "track/Track.h"

#include <span>

namespace faintline {

/// Smoothed tracks of one analysis, with what turns their points into seconds and hertz.
struct TracksOnAxes {
    std::span<const Track> tracks; ///< with one smoothed point a point
    const Axis &time;
    const Axis &frequency;
    double cellHz = 0.0; ///< resolution 1/T_FT
};

/// Of the energy that tracks of a shorter window followed, the share that those of a longer one followed at the same
/// places:
///
///   E(X) = Σ r(t) over all tracks within X's path ± 1 cell of the shorter window, in X's time
///   share = E_longer(X)/E_shorter(X)
///
/// r is a signal's power over the noise's in one frame. As many frames a window on both sides, so a steady line has the
/// same E in both: its r grows with T_FT as the number of frames falls. Of one that moves by more than a cell within
/// the longer window the power spreads over several cells, of which a path follows one. Answers the median over the
/// tracks X of at least `leastStatistic` that the longer window has seen at all, weighted by their duration; NaN
/// without such tracks.
double energyKept(const TracksOnAxes &shorter, const TracksOnAxes &longer, double leastStatistic);

} // namespace faintline
