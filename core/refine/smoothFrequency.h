#pragma once

#include "plan/AnalysisPlan.h"
#include "signal/FrequencyCurve.h"
#include "track/Track.h"

namespace faintline {

/// The smoothed frequency of a track, Hz, along which to straighten a recording (StraightenedRecording).
///
/// One knot per frame. z minimises Σ w_i (z_i - f_i)² + λ Σ (z_{i-1} - 2 z_i + z_{i+1})², the Whittaker smoother; w_i
/// is the presence over the variance of the track's position, 1 without either. λ is chosen so that a wander with a
/// period of `smoothingSeconds` is halved: λ = (2 sin(π·step/smoothingSeconds))⁻⁴; 0 selects 32 frames. Beyond the
/// track's ends the curve continues straight for half that period, but at most half the track's length, and is then
/// constant. Source: Whittaker 1923. Oracle: a dense solution, and the closed form of a sine's gain. Throws Error for a
/// period of less than 2 frames or more than 4096, beyond which the equations are too stiff.
FrequencyCurve smoothFrequency(const AnalysisPlan &plan, const Track &track, double smoothingSeconds = 0.0);

} // namespace faintline
