#pragma once

#include "analysis/AnalysisSettings.h"
#include "base/RunContext.h"
#include "base/json.h"
#include "evaluate/experiments/LineExperiment.h"
#include "evaluate/experiments/RunOutcome.h"
#include "recording/Recording.h"
#include "recording/Truth.h"

#include <string>
#include <vector>

namespace faintline {

/// What the values of one numeric setting are worth: the whole chain on known lines, value after value.
///
/// A *trial* is a stretch of noise with one line in its middle, in simulated white noise or added to a recording:
/// `marginSeconds` before it, the line, and `marginSeconds` after it. Every value is tried on the same trials, so that
/// values differ by what they do and not by chance. A track that lies on the line, within 1.5 resolution cells, for
/// half of its points while the line lasts has detected it; one that never touches it is a false alarm. In a recording
/// everything that was there before counts as one, too.
///
/// Runs cycle through the values: run = trial · values + value, so half of the runs give half of the trials of every
/// value.
struct SweepExperiment {
    std::string recording; ///< path; empty: simulated white noise
    bool iq = false;       ///< two channels as I and Q
    int seed = 1;
    int trials = 40;    ///< of every value
    double snrDb = 0.0; ///< in a rectangular window of the settings' T_FT, over the noise at the line's place
    double durationSeconds = 20.0;
    double driftHzPerSecond = 0.0;
    double wanderHz = 0.0;
    double wanderSeconds = 10.0;
    double marginSeconds = 20.0;
    double sampleRateHz = 1000.0; ///< of simulated noise
    AnalysisSettings settings;    ///< all but the parameter
    std::string parameter;        ///< a setting that is a number: "model.snr"
    std::vector<double> values;

    static const std::vector<Field<SweepExperiment>> &fields();
    bool operator==(const SweepExperiment &) const = default;

    double trialSeconds() const { return durationSeconds + 2.0 * marginSeconds; }
    int runs() const { return trials * int(values.size()); }
    int valueOf(int run) const { return run % int(values.size()); }
    int trialOf(int run) const { return run / int(values.size()); }
};

/// `steps` values from `from` to `to`, evenly spaced or by equal factors; whole where the setting is, without repeats.
/// Throws Error.
std::vector<double> sweepValues(const std::string &parameter, double from, double to, int steps, bool isLogarithmic);

/// Whether a setting can be swept: it holds one number.
bool isSweepable(const FieldInfo &field);

/// The settings with one value. Throws Error where they cannot be so.
AnalysisSettings settingsAt(const SweepExperiment &experiment, std::size_t value);

/// Throws Error naming the key.
void checkExperiment(const SweepExperiment &experiment);

/// {"kind": "sweep", "parameter": "model.snr", "values": […] or {"from": …, "to": …, "steps": …, "scale": "linear" or
/// "log"},
///  "settings": {…}, …}; throws Error.
SweepExperiment sweepExperimentFromJson(const Json &json, const std::string &where);
Json toJson(const SweepExperiment &experiment);

/// What one run of a sweep leaves behind, as a RunOutcome: noise = {{false alarms, seconds looked at}}, signal =
/// {{{seconds from the line's start to its detection}}}, -∞ where it was missed.
RunOutcome sweepOutcome(int run, std::ptrdiff_t falseAlarms, double seconds, double latencySeconds);

/// What all runs of a sweep share: the recording, and a calibration for each value.
class SweepTrials
{
public:
    /// `recording` may be null where noise is simulated. Calibrates every value. Throws Error, Cancelled.
    SweepTrials(const SweepExperiment &experiment, RecordingPointer recording, const RunContext &context = {});

    /// The thresholds, one per value.
    const std::vector<double> &thresholds() const { return m_thresholds; }

    /// Does the given runs on context.threads threads. Depends on nothing but the experiment and the recording.
    std::vector<RunOutcome> run(const std::vector<int> &runs, const RunContext &context = {},
                                const RunSink &sink = {}) const;

    /// One trial made again: the recording with its line, and the line's truth. The settings select the stretch.
    struct Made {
        RecordingPointer recording;
        TruthLine truth;
        AnalysisSettings settings; ///< with the value of the run
    };
    Made remake(int run) const;

    /// Processor seconds for an hour of recording, value by value (measureCost): not the same twice.
    std::vector<double> costs(const RunContext &context = {}) const;

private:
    struct Placement;
    LineSettings lineAt(const Placement &placement) const; ///< from the beginning of its stretch
    Made simulate(const LineSettings &line, const Placement &placement, const AnalysisSettings &settings) const;
    Made inject(LineSettings line, const Placement &placement, const AnalysisSettings &settings) const;

    SweepExperiment m_experiment; ///< its window's length known
    RecordingPointer m_recording;
    std::vector<double> m_thresholds;
};

} // namespace faintline
