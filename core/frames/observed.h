#pragma once

#include "frames/Spectrogram.h"

namespace faintline {

/// Whether all samples in a frame's window were observed (Recording::isObserved). Otherwise the frame was not observed:
/// its power is 0 throughout, as in digital silence, so it does not affect the noise estimate, and its normalised value
/// is NaN.
inline bool isObserved(const Spectrogram &spectrogram, Index frame)
{
    return spectrogram.recording().isObserved(spectrogram.selection().channel,
                                              spectrogram.firstSample() + frame * spectrogram.hopSamples(),
                                              spectrogram.windowSamples());
}

} // namespace faintline
