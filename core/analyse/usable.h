#pragma once

#include "base/RunContext.h"
#include "frames/Spectrogram.h"
#include "noise/NoiseBackground.h"

#include <string>

namespace faintline {

/// What is to be said of a spectrogram's part of a recording that is silent, as a recorder without its microphone leaves
/// it: a valid recording without events. Empty for others. Throws Error with a one-sentence reason if samples that are
/// not finite leave none to use. Costs nothing if the background found any power, else one reading.
std::string silenceWords(const Spectrogram &spectrogram, const NoiseBackground &background,
                         const RunContext &context = {});
/// The same of so many samples, which are known to be silent.
std::string silenceWords(Index samples);

} // namespace faintline
