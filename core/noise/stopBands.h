#pragma once

#include "frames/Spectrogram.h"
#include "noise/NoiseBackground.h"

#include <vector>

namespace faintline {

/// The bands at the ends of the spectrum that a filter left of the noise beside them: behind the cut-off of a receiver,
/// or above the old Nyquist frequency of a recording that was resampled. What is there are images, leakage and
/// remainders of the pass band, which have no noise of their own over which a signal could be told.
///
/// Two conditions, both necessary, on the median over time of the background, ℓ(f), and on `frames`, windows side by
/// side with one bin a cell:
///
///   step      There is a width w with ℓ(f) - ℓ(f + w) ≥ 20 dB, everything from f + w up to the end is as low, and over
///             as many cells before and behind, ℓ changes by less than a quarter of that: noise falls, is flat before
///             and flat behind. Power laws, however steep, fall by more than a quarter of an octave in the next half
///             octave, and linear slopes by as much again; as w ≤ f, none has such a step.
///   following From one window to the next, the levels of the band and of as many cells of the pass band beside it rise
///             or fall together in two of three pairs of windows at least, as with a correlation of ½. Levels of
///             independent noise do in half of them; of the 128 pairs required, two thirds by chance once in 10⁴.
///
/// A band with noise of its own, though it be faint, varies by itself; so do all bands while the noise is steady, apart
/// from images. Bands and pass bands narrower than the background's own window (24 cells) are not examined, nor is a
/// selected band, whose ends are the user's.
std::vector<StopBand> findStopBands(const Spectrogram &frames, const NoiseBackground &background);

} // namespace faintline
