#pragma once

#include "model/KinematicAxis.h"
#include "model/Likelihood.h"
#include "track/PathStrip.h"
#include "track/presence.h"

#include <vector>

namespace faintline {

/// What the look from both ends has to know of the detection that found a track.
struct BothWaysModel {
    const KinematicAxis *axis = nullptr;
    Likelihood likelihood;  ///< the detector's
    double threshold = 0.0; ///< nat
    double binsPerCell = 1.0;
    std::vector<double> lnK; ///< of each frame of the strip
};

/// A track seen from both ends; one value a frame of its strip.
struct BothWays {
    Presence presence;
    std::vector<double> positions; ///< below a cell
    std::vector<double> levels;    ///< signal power over the noise's, mean along the path over ±12 frames
    /// What the detector's account says of the mean path in each frame: λ + ln K + ln h(0), nat.
    std::vector<double> gains;
};

/// Half-width of a strip that this look needs, in bins.
Index bothWaysHalfWidth(double binsPerCell);

/// Of the corridor alone, in bins.
Index corridorHalfWidth(double binsPerCell);

/// Takes the posterior of presence and place in a corridor of ±3 resolution cells around the strip's path, twice, the
/// second time around the first one's mean.
///
///   r(t) = mean of y along the path over ±12 frames, less 1; λ is the likelihood's at SNR clamp(r, ½, 4), in half
///          octaves
///   an onset or an end costs max(T/2, 2) nat, T the threshold
///   f(t) = maximum of the power averaged along the mean path over ±clamp(10/r, 1, 8) frames, by a parabola through its
///          logarithm, at most one bin from the mean
///
/// A line that stops is given up sooner the stronger it is; up to SNR 4, so that a keyed one stays one.
BothWays lookBothWays(const PathStrip &strip, const BothWaysModel &model);

/// How often the track's slope changed by 0, 1, … steps (expectedSlopeChanges), at its own level.
std::vector<double> slopeChangesOf(const PathStrip &strip, const BothWaysModel &model);

/// The detector's own score of the strongest path in the corridor, nat.
double strongestIn(const PathStrip &strip, const BothWaysModel &model);

} // namespace faintline
