#pragma once

#include "base/RunContext.h"
#include "spectrum/NoiseBackground.h"
#include "spectrum/Spectrogram.h"

namespace faintline {

/// Throws Error with a one-sentence reason if a spectrogram's part of a recording holds no usable sample: all are 0,
/// below the range of single precision, or not finite. Costs nothing if the background found any power, else one
/// reading.
void checkUsable(const Spectrogram &spectrogram, const NoiseBackground &background, const RunContext &context = {});

} // namespace faintline
