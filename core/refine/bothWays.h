#pragma once

#include "model/KinematicAxis.h"
#include "model/Likelihood.h"
#include "recursion/PathStrip.h"
#include "recursion/presence.h"

#include <vector>

namespace faintline {

/// Parameters of the detection that found a track, for the two-sided pass.
struct BothWaysModel {
    const KinematicAxis *axis = nullptr;
    Likelihood likelihood;  ///< the detector's
    double threshold = 0.0; ///< nat
    double binsPerCell = 1.0;
    std::vector<double> lnK; ///< for each frame of the strip
    CorridorEnds ends;       ///< of the strip, for BothWays::endsBy
};

/// A track estimated from past and future; one value per frame of its strip.
struct BothWays {
    Presence presence;
    std::vector<double> positions; ///< with subcell precision
    std::vector<double> levels;    ///< signal power over the noise's, mean along the path over ±12 frames
    /// Gain of the mean path in each frame under the detector's recursion: λ + ln K + ln h(0), nat.
    std::vector<double> gains;
    /// Probability that the signal is present, with the level of the 24 frames before or after: where it begins and
    /// ends.
    std::vector<float> endsBy;
};

/// Half width in bins of the strip that lookBothWays needs.
Index bothWaysHalfWidth(double binsPerCell);

/// Half width in bins of the corridor alone.
Index corridorHalfWidth(double binsPerCell);

/// Computes the posterior of presence and position in a corridor of ±3 resolution cells around the strip's path, twice,
/// the second time around the mean of the first.
///
///   r(t) = mean of y along the path over ±12 frames, less 1; λ is the likelihood's at SNR clamp(r, ½, 4), in half
///          octaves
///   an onset or an end costs max(T/2, 2) nat, T the threshold
///   f(t) = maximum of the power averaged along the mean path over ±clamp(10/r, 1, 8) frames, by a parabola through its
///          logarithm, at most one bin from the mean
///
/// Presence is then computed once more, along the same corridor, for the level that a frame has if the signal goes on
/// as before or after it: the largest r of t, t - 12 and t + 12, over the floor in that frame. If the signal is absent outside the strip (`ends`),
/// the evidence alone decides where it begins and ends; otherwise noise before it would count as signal, because an
/// onset inside the strip costs T/2. The stronger a line, the sooner its end is recognised; only the presence that
/// decides what is one track is limited to SNR 4, so that a keyed line stays one. The likelihood is the detector's, or,
/// if that explains the powers along the path better, the exponential one of an amplitude that varies from frame to
/// frame: in a strong signal that fades, power far below its mean is far above the noise's.
BothWays lookBothWays(const PathStrip &strip, const BothWaysModel &model);

/// Expected number of slope changes by 0, 1, … steps (expectedSlopeChanges), at the track's own level.
std::vector<double> slopeChangesOf(const PathStrip &strip, const BothWaysModel &model);

/// The detector's score of the strongest path in the corridor, nat.
double strongestIn(const PathStrip &strip, const BothWaysModel &model);

} // namespace faintline
