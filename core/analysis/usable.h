#pragma once

#include "base/RunContext.h"
#include "spectrum/NoiseBackground.h"
#include "spectrum/Spectrogram.h"

namespace faintline {

/// Throws Error, one sentence that says why, where the part of a recording that a spectrogram looks at holds no sample
/// that could be used: all are 0, below what single precision holds, or not finite. Cost: nothing where the background
/// heard anything, else one reading.
void checkUsable(const Spectrogram &spectrogram, const NoiseBackground &background, const RunContext &context = {});

} // namespace faintline
