#pragma once

#include <functional>
#include <vector>

namespace faintline {

/// What one run leaves behind: all that any estimate of Pd, Pfa or ROC needs.
struct RunOutcome {
    int run = 0;
    /// [detector][block]: largest D on the noise alone.
    std::vector<std::vector<float>> noise;
    /// [detector][SNR][signal]: largest D at the line's own frequency while it lasts.
    std::vector<std::vector<std::vector<float>>> signal;

    bool operator==(const RunOutcome &) const = default;
};

/// Called with every finished run, in any order, from one thread at a time.
using RunSink = std::function<void(const RunOutcome &)>;

} // namespace faintline
