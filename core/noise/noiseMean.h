#pragma once

#include "frames/NormalisedFrames.h"

#include <string>

namespace faintline {

/// Mean of the noise of ready-made frames, which all later stages assume to be 1: median/ln 2, as for exponential
/// noise, of the observed cells of up to 64 evenly spread frames. 1 if there are no such cells. Signals in a tenth of
/// the cells raise it by a sixth.
double noiseMeanOf(const NormalisedFrames &frames);

/// A sentence that describes a wrong noise mean; empty from half to twice the correct value, a range that noise of
/// other laws also reaches.
std::string noiseMeanWarning(const NormalisedFrames &frames);

} // namespace faintline
