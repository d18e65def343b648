#pragma once

#include "spectrum/NoiseBackground.h"
#include "spectrum/Spectrogram.h"

#include <span>
#include <vector>

namespace faintline {

/// One frame of a spectrogram over its noise: values ← values/B at the time `seconds`, 0 in digital silence; ln B is
/// interpolated between the background's cells. With `guardsAgainstClicks`, a sub-band most of which is far above its
/// background is divided by that excess. `ln` is scratch memory.
void normaliseFrame(const Spectrogram &spectrogram, const NoiseBackground &background, double seconds,
                    bool guardsAgainstClicks, std::span<float> values, std::vector<float> &ln);

} // namespace faintline
