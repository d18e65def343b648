#pragma once

#include "frames/Spectrogram.h"
#include "noise/NoiseBackground.h"

namespace faintline {

/// Frames from which a background is estimated: the spectrogram's windows, `stepsPerWindow` per window length, with one
/// bin per resolution cell. A narrow band, which has too little noise of its own, includes its neighbourhood.
Spectrogram coarseFrames(const Spectrogram &spectrogram, const NormaliserSettings &settings, int stepsPerWindow);

} // namespace faintline
