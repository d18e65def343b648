#pragma once

#include "base/RunContext.h"
#include "spectrum/NoiseBackground.h"
#include "spectrum/NormalisedFrames.h"
#include "spectrum/Spectrogram.h"

#include <memory>

namespace faintline {

/// A spectrogram over its noise, as the settings ask for it: NormalisedSpectrogram, or with `noise.causal`
/// CausalSpectrogram.
NormalisedFramesPointer normalise(std::shared_ptr<const Spectrogram> spectrogram, const NormaliserSettings &settings,
                                  const RunContext &context = {});

} // namespace faintline
