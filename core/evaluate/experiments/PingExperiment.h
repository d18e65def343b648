#pragma once

#include "base/RunContext.h"
#include "evaluate/comparison/trackScore.h"
#include "plan/AnalysisSettings.h"

#include <cstdint>
#include <vector>

namespace faintline {

/// The whole chain of Parsons' Figure 1 on known targets: independent runs, each with its own noise, after a common
/// field of settled noise.
struct PingExperiment {
    PingScene scene;           ///< with another seed in each run
    AnalysisSettings settings; ///< one model, threshold in nats
    int runs = 12;
    int settlingPings = 200;
    std::uint64_t seed = 1;
    std::vector<Index> gateCells{3, 1};
};

/// The scores of the runs, in order: a pure function of (experiment, run), independent of the number of threads. Throws
/// Error, Cancelled.
std::vector<TrackScore> runPings(const PingExperiment &experiment, const RunContext &context = {});

} // namespace faintline
