#pragma once

#include "frames/Spectrogram.h"

namespace faintline {

/// Number of channels whose evidence is added. Throws Error if it depends on the recording.
int channelCount(const SelectionSettings &selection);

} // namespace faintline
