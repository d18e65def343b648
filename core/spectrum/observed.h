#pragma once

#include "spectrum/Spectrogram.h"

namespace faintline {

/// Whether the window of a frame holds nothing but samples that were heard (Recording::isWhole). A frame whose window
/// does not was not observed: its power is 0 throughout, as that of digital silence, so it tells nothing of the noise,
/// and normalised it is NaN.
inline bool isObserved(const Spectrogram &spectrogram, Index frame)
{
    return spectrogram.recording().isWhole(spectrogram.firstSample() + frame * spectrogram.hopSamples(),
                                           spectrogram.windowSamples());
}

} // namespace faintline
