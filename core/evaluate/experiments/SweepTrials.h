#pragma once

#include "evaluate/experiments/Experiment.h"
#include "evaluate/experiments/Trials.h"
#include "plan/Calibration.h"

#include <vector>

namespace faintline {

/// Result of one run of a sweep as a RunOutcome: noise = {{false alarms, observed seconds}}, signal = {{{seconds from
/// the line's start to its detection}}}, -∞ if it was missed.
RunOutcome sweepOutcome(int run, std::ptrdiff_t falseAlarms, double seconds, double latencySeconds);

/// The runs of a sweep. The thresholds are one per value; if a window is chosen in each trial, those of the window T0.
class SweepTrials : public Trials
{
public:
    /// `recording` may be null for simulated noise. Calibrates each value. Throws Error, Cancelled.
    SweepTrials(const Experiment &experiment, RecordingPointer recording, const RunContext &context = {});

    /// The settings have the run's value, and select the stretch.
    struct SweptTrial : MadeTrial {
        AnalysisSettings settings;
    };
    SweptTrial remake(int run) const;

    /// Processor seconds per hour of recording, value by value (measureCost); varies between calls.
    std::vector<double> costs(const RunContext &context = {}) const;

private:
    RunOutcome outcomeOf(int run, const RunContext &quiet) const override;
    struct Placement;
    LineSettings lineAt(const Experiment &one, const Placement &placement) const; ///< from its stretch's start
    SweptTrial simulate(const Experiment &one, const LineSettings &line, const Placement &placement) const;
    SweptTrial inject(const Experiment &one, LineSettings line, const Placement &placement) const;

    Experiment m_experiment;
    RecordingPointer m_recording;
    std::vector<StopBand> m_stopBands; ///< of the recording: no line is placed there
    double m_referenceSeconds;         ///< the window to which an SNR refers
};

} // namespace faintline
