#pragma once

#include "spectrum/NormalisedFrames.h"

#include <string>

namespace faintline {

/// The mean of the noise of ready-made frames, which everything from here on takes to be 1: median/ln 2 of the cells of
/// up to 64 frames, evenly spread, as of exponential noise; cells that are not observed do not count. 1 if there are no
/// such cells. Signals in a tenth of the cells raise it by a sixth.
double noiseMeanOf(const NormalisedFrames &frames);

/// What is wrong with it, as a sentence; empty from half to twice what it should be, which noise of other laws has as
/// well.
std::string noiseMeanWarning(const NormalisedFrames &frames);

} // namespace faintline
