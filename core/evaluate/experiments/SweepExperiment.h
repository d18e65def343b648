#pragma once

#include "base/json.h"
#include "evaluate/experiments/LineExperiment.h"
#include "plan/AnalysisSettings.h"

#include <string>
#include <vector>

namespace faintline {

/// Performance of `detect`, from samples to tracks, on known lines for different values of one number: a setting, or a
/// property of the line.
///
/// A *trial* is a stretch of noise with one line in its middle, in simulated white noise or added to a recording:
/// `marginSeconds` before it, the line, and `marginSeconds` after it. All values use the same trials, so that
/// differences are not due to chance. A window that the settings leave open is chosen in each trial. A track that
/// detects the line (lineDetection.h) gives its latency; one that never touches it is a false alarm. In a recording,
/// existing signals also count as false alarms.
///
/// Runs cycle through the values: run = trial · values + value, so half of the runs give half of the trials of each
/// value.
struct SweepExperiment {
    std::string recording{}; ///< path; empty: simulated white noise
    bool iq = false;         ///< two channels as I and Q
    int seed = 1;
    int trials = 40;    ///< per value
    double snrDb = 0.0; ///< in a rectangular window of T_FT or the automatic T0, over the noise at the line's place
    double durationSeconds = 20.0;
    double driftHzPerSecond = 0.0;
    double wanderHz = 0.0;
    double wanderSeconds = 10.0;
    double marginSeconds = 20.0;
    double sampleRateHz = 1000.0; ///< for simulated noise
    AnalysisSettings settings{};  ///< all settings except the parameter
    std::string parameter{};      ///< "model.snr", or "snrDb" or another number of the line
    std::vector<double> values{};

    static const std::vector<Field<SweepExperiment>> &fields();
    bool operator==(const SweepExperiment &) const = default;

    double trialSeconds() const { return durationSeconds + 2.0 * marginSeconds; }
    int runs() const { return trials * int(values.size()); }
    int valueOf(int run) const { return run % int(values.size()); }
    int trialOf(int run) const { return run / int(values.size()); }
};

/// `steps` values from `from` to `to`, evenly spaced or at a constant ratio; integers if the setting is one, without
/// duplicates. Throws Error.
std::vector<double> sweepValues(const std::string &parameter, double from, double to, int steps, bool isLogarithmic);

/// Whether a setting can be swept: it holds one number.
bool isSweepable(const FieldInfo &field);

/// The properties of the line that can be varied: snrDb, durationSeconds, driftHzPerSecond, wanderHz, wanderSeconds.
const std::vector<Field<SweepExperiment>> &lineProperties();

/// What is varied: a setting, or a property of the line. Throws Error.
const FieldInfo &parameterInfo(const std::string &parameter);

/// The experiment with one of the values, in its settings or its line. Throws Error if they are invalid.
SweepExperiment experimentAt(const SweepExperiment &experiment, std::size_t value);

/// Throws Error naming the key.
void checkExperiment(const SweepExperiment &experiment);

/// {"kind": "sweep", "parameter": "model.snr", "values": […] or {"from": …, "to": …, "steps": …, "scale": "linear" or
/// "log"},
///  "settings": {…}, …}; throws Error.
SweepExperiment sweepExperimentFromJson(const Json &json, const std::string &where);
Json toJson(const SweepExperiment &experiment);

} // namespace faintline
