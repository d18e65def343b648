#pragma once

#include "analysis/Analysis.h"
#include "spectrum/FrequencyCurve.h"

namespace faintline {

/// The smooth frequency of a track, Hz: to straighten a recording along (StraightenedRecording).
///
/// One knot a frame. z minimises Σ w_i (z_i - f_i)² + λ Σ (z_{i-1} - 2 z_i + z_{i+1})², the Whittaker smoother;
/// w_i is the presence over the variance of the track's 5-95 % band, 1 without either. λ is chosen so that a wander with a
/// period of `smoothingSeconds` is halved: λ = (2 sin(π·step/smoothingSeconds))⁻⁴; 0 stands for 32 frames. Beyond the
/// track's ends the curve goes on straight for half that period, then stays. Source: Whittaker 1923.
/// Oracle: a dense solution, and the closed form of a sine's gain. Throws Error for a period of less than two frames.
FrequencyCurve smoothFrequency(const AnalysisPlan &plan, const Track &track, double smoothingSeconds = 0.0);

/// How far the largest power of one transform of a recording's part stands out, dB.
struct LineHeight {
    double hz = 0.0;
    double db = 0.0; ///< over the median of the band
};

/// The highest line within ±halfBandHz of a frequency, in one Hann-windowed transform of a whole stretch; the band is mixed
/// down and averaged to few samples before, so stretches of hours are possible. Resolution: 1.5 over the duration.
/// Throws Error where the stretch holds less than 16 such samples.
LineHeight heightInOneTransform(const Recording &recording, int channel, double fromSeconds, double toSeconds,
                                double hz, double halfBandHz);

} // namespace faintline
