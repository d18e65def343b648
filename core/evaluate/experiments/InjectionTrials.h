#pragma once

#include "base/RunContext.h"
#include "evaluate/experiments/InjectionExperiment.h"
#include "evaluate/experiments/RunOutcome.h"
#include "scene/Truth.h"
#include "signal/Recording.h"

#include <memory>
#include <vector>

namespace faintline {

/// Shared by all trials of an experiment: the recording, its background, the detectors' thresholds.
class InjectionTrials
{
public:
    /// Estimates the recording's noise, calibrates each detector, finds existing signals and measures thresholds.
    /// Throws Error, Cancelled.
    InjectionTrials(const InjectionExperiment &experiment, RecordingPointer recording, const RunContext &context = {});
    ~InjectionTrials();

    /// The thresholds, one per detector.
    const std::vector<double> &thresholds() const { return m_thresholds; }

    /// Runs the given trials on context.threads threads; run = trial, noise = [detector][0] without the line, signal =
    /// [detector][SNR][0] with it. Depends only on the experiment and the recording.
    std::vector<RunOutcome> run(const std::vector<int> &trials, const RunContext &context = {},
                                const RunSink &sink = {}) const;

    /// The recording with one trial's line, and the line's truth.
    struct Made {
        RecordingPointer recording;
        TruthLine truth;
    };
    Made remake(int trial, double snrDb) const;

private:
    struct Shared;
    class LineLook;
    InjectionExperiment m_experiment;
    std::unique_ptr<const Shared> m_shared;
    std::vector<double> m_thresholds;
};

} // namespace faintline
