#pragma once

#include "base/RunContext.h"
#include "frames/NormalisedFrames.h"
#include "frames/Spectrogram.h"
#include "noise/NoiseBackground.h"

#include <memory>

namespace faintline {

/// Normalises a spectrogram by its noise: NormalisedSpectrogram, or CausalSpectrogram with `noise.causal`.
NormalisedFramesPointer normalise(std::shared_ptr<const Spectrogram> spectrogram, const NormaliserSettings &settings,
                                  const RunContext &context = {});

} // namespace faintline
