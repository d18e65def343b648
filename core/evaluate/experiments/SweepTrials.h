#pragma once

#include "base/RunContext.h"
#include "evaluate/experiments/RunOutcome.h"
#include "evaluate/experiments/SweepExperiment.h"
#include "plan/Calibration.h"
#include "scene/Truth.h"
#include "signal/Recording.h"

#include <vector>

namespace faintline {

/// Result of one run of a sweep as a RunOutcome: noise = {{false alarms, observed seconds}}, signal = {{{seconds from
/// the line's start to its detection}}}, -∞ if it was missed.
RunOutcome sweepOutcome(int run, std::ptrdiff_t falseAlarms, double seconds, double latencySeconds);

/// Shared by all runs of a sweep: the recording, and a calibration for each value.
class SweepTrials
{
public:
    /// `recording` may be null for simulated noise. Calibrates each value. Throws Error, Cancelled.
    SweepTrials(const SweepExperiment &experiment, RecordingPointer recording, const RunContext &context = {});

    /// The thresholds, one per value; if a window is chosen in each trial, those of the window T0.
    const std::vector<double> &thresholds() const { return m_thresholds; }

    /// Executes the given runs on context.threads threads. Depends only on the experiment and the recording.
    std::vector<RunOutcome> run(const std::vector<int> &runs, const RunContext &context = {},
                                const RunSink &sink = {}) const;

    /// One trial regenerated: the recording with its line, and the line's truth. The settings select the stretch.
    struct SweptTrial {
        RecordingPointer recording;
        TruthLine truth;
        AnalysisSettings settings; ///< with the run's value
    };
    SweptTrial remake(int run) const;

    /// Processor seconds per hour of recording, value by value (measureCost); varies between calls.
    std::vector<double> costs(const RunContext &context = {}) const;

private:
    struct Placement;
    LineSettings lineAt(const SweepExperiment &one, const Placement &placement) const; ///< from its stretch's start
    SweptTrial simulate(const SweepExperiment &one, const LineSettings &line, const Placement &placement) const;
    SweptTrial inject(const SweepExperiment &one, LineSettings line, const Placement &placement) const;

    SweepExperiment m_experiment;
    RecordingPointer m_recording;
    std::vector<StopBand> m_stopBands; ///< of the recording: no line is placed there
    double m_referenceSeconds;         ///< the window to which an SNR refers
    std::vector<double> m_thresholds;
};

} // namespace faintline
