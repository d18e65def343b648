#pragma once

#include "frames/PeakPyramid.h"
#include "noise/NoiseNormaliser.h"

#include <memory>

namespace faintline {

/// A quick look at a recording of any length: frames spread evenly over it, in dB over a background from a few of them.
///
/// At most 256 frames, fewer for long windows: some 2²⁵ samples are transformed, which takes a fraction of a second.
/// Its time axis is that of the frames it holds. For display only: it shows nothing between these frames.
std::shared_ptr<const PeakPyramid> quickLook(std::shared_ptr<const Spectrogram> spectrogram,
                                             const NormaliserSettings &settings, const RunContext &context = {});

} // namespace faintline
