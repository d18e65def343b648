#pragma once

#include "spectrum/NoiseNormaliser.h"
#include "spectrum/PeakPyramid.h"

#include <memory>

namespace faintline {

/// A first look at a recording of any length: frames that lie evenly over all of it, in dB over a background from a few
/// of them.
///
/// At most 256 frames, fewer where the windows are long: some 2²⁵ samples are transformed, which takes a fraction of a
/// second. Its time axis is that of the frames it holds. For the eye only: it tells nothing of what lies between them.
std::shared_ptr<const PeakPyramid> quickLook(std::shared_ptr<const Spectrogram> spectrogram,
                                             const NormaliserSettings &settings, const RunContext &context = {});

} // namespace faintline
