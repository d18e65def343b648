#pragma once

#include "analysis/analyse.h"
#include "track/DetectionChain.h"

#include <memory>

namespace faintline {

/// The detection chain that an analysis's settings, model, calibration and threshold describe, at its first frame.
std::unique_ptr<DetectionChain> makeChain(const Analysis &analysis);

} // namespace faintline
