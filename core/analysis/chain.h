#pragma once

#include "analysis/analyse.h"
#include "track/DetectionChain.h"

#include <memory>

namespace faintline {

/// The detection chain that an analysis's settings, model, calibration and threshold describe, at its first frame.
std::unique_ptr<DetectionChain> makeChain(const Analysis &analysis);

/// The detector of that chain alone, without tracks and what they feed back.
std::unique_ptr<Detector> makeDetector(const Analysis &analysis);

} // namespace faintline
