#pragma once

#include "base/RunContext.h"
#include "calibrate/noiseStreams.h"
#include "detect/Detector.h"
#include "plan/RareRates.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace faintline {

struct SplittingSettings {
    int entries = 1000;         ///< trials per level, over all runs
    int pilots = 200;           ///< trials of each run that determine the next level
    double leastLnRate = -25.0; ///< levels continue until cycles are as rare as this, per cell and frame
    std::uint64_t seed = 3000;
};

/// Calls `makeDetector` and `makeNoise` once per thread. Results do not depend on the number of threads. Empty if the
/// detector cannot save its state, if the state is too large, or if all trials soon descend from a few large cells, as
/// with short windows (P out of N): the scatter of the runs then exceeds a half before rates are rare.
RareRates measureRareRates(const std::function<std::unique_ptr<Detector>()> &makeDetector,
                           const std::function<std::unique_ptr<NoiseStream>()> &makeNoise,
                           const SplittingSettings &settings, const RunContext &context = {});

} // namespace faintline
