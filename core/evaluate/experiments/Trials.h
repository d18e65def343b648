#pragma once

#include "base/RunContext.h"
#include "scene/Truth.h"
#include "signal/Recording.h"

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

/// A trial made again: its recording with the line, and the line's truth.
struct MadeTrial {
    RecordingPointer recording;
    TruthLine truth;
};

/// Called for each finished run, in any order, by one thread at a time.
using RunSink = std::function<void(const RunOutcome &)>;

/// The runs of an experiment, with what they share: calibrations, and the recording if there is one.
class Trials
{
public:
    virtual ~Trials() = default;

    /// One for each detector or value; empty: each noise block's maximum serves as one.
    const std::vector<double> &thresholds() const { return m_thresholds; }

    /// Executes the given runs on context.threads threads; the result is in the order of `runs` and depends only on the
    /// experiment and its recording. Throws Error, Cancelled.
    std::vector<RunOutcome> run(const std::vector<int> &runs, const RunContext &context = {},
                                const RunSink &sink = {}) const;

protected:
    virtual RunOutcome outcomeOf(int run, const RunContext &quiet) const = 0;

    std::vector<double> m_thresholds;
};

} // namespace faintline
