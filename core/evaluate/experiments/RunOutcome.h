#pragma once

#include <functional>
#include <vector>

namespace faintline {

/// Result of one run: everything needed to estimate Pd, Pfa or ROC.
struct RunOutcome {
    int run = 0;
    /// [detector][block]: largest D on noise alone.
    std::vector<std::vector<float>> noise;
    /// [detector][SNR][signal]: largest D at the line's own frequency while it lasts.
    std::vector<std::vector<std::vector<float>>> signal;

    bool operator==(const RunOutcome &) const = default;
};

/// Called for each finished run, in any order, by one thread at a time.
using RunSink = std::function<void(const RunOutcome &)>;

} // namespace faintline
