#pragma once

#include "spectrum/NoiseBackground.h"
#include "spectrum/Spectrogram.h"

namespace faintline {

/// What a background is estimated from: the spectrogram's windows, `stepsPerWindow` of them a window's length, with one
/// bin per resolution cell and the neighbourhood of a narrow band, which has no noise of its own to speak of.
Spectrogram coarseFrames(const Spectrogram &spectrogram, const NormaliserSettings &settings, int stepsPerWindow);

} // namespace faintline
