#pragma once

#include "frames/NormalisedFrames.h"
#include "plan/makeDetector.h"

#include <vector>

namespace faintline {

/// ln K in force, and the fraction of all states that continue with it.
struct ResetFit {
    double lnK = 0.0;
    double continuedFraction = 0.0;
};

/// Determines ln K on noise fields, after the first 300 frames of each: by bisection for half of the states continued
/// if the settings specify that, or measures the effect of the given law. Cost: about eight passes over the fields.
ResetFit fitReset(const std::vector<NormalisedFramesPointer> &noise, const MarkovModel &model, const SmdSettings &smd);

} // namespace faintline
