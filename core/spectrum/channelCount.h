#pragma once

#include "spectrum/Spectrogram.h"

namespace faintline {

/// How many channels' evidence is added. Throws Error where that depends on the recording.
int channelCount(const SelectionSettings &selection);

} // namespace faintline
