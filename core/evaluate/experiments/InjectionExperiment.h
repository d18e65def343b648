#pragma once

#include "analysis/AnalysisSettings.h"
#include "base/RunContext.h"
#include "base/json.h"
#include "evaluate/experiments/LineExperiment.h"
#include "recording/Recording.h"
#include "recording/Truth.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace faintline {

/// Detection of known lines added to a real recording: Pd in this noise.
///
/// A *trial* adds one line at a random time and frequency of the selection, away from all signals, and asks every
/// detector whether its statistic exceeds its threshold within half a resolution cell of the line while it lasts; a
/// detector that decides at the end of blocks, which stand where they do in the whole recording, also at the first end
/// after the line. All trials count for all detectors.
///
/// Signals are what the chain of any detector tracks at a thousandth of the false alarms asked for; they are kept from
/// all detectors alike (y = 0). Thresholds give every detector the same number of false alarms in the rest of this
/// recording (measuredThreshold), counted in blocks as long as a line and 12 resolution cells wide, on the same
/// statistic that the trials are judged by.
struct InjectionExperiment {
    std::string recording; ///< path, as text (base/fileName.h)
    bool iq = false;       ///< two channels as I and Q
    int seed = 1;
    int trials = 200;
    std::vector<double> snrDb{-3.0, 0.0, 3.0}; ///< in a rectangular window of T_FT, over the noise at the line's place
    double durationSeconds = 60.0;
    double driftHzPerSecond = 0.0;
    double wanderHz = 0.0;
    double wanderSeconds = 10.0;
    double falseAlarmsPerHour = 1.0;
    AnalysisSettings settings;                ///< selection, spectrogram and noise, the same for all detectors
    std::vector<DetectorUnderTest> detectors; ///< their settings on top of these

    static const std::vector<Field<InjectionExperiment>> &fields();
    bool operator==(const InjectionExperiment &) const = default;
};

/// {"kind": "injection", "recording": …, "settings": {…}, "detectors": [{"name": …, "settings": {…}}], …}; throws
/// Error.
InjectionExperiment injectionExperimentFromJson(const Json &json, const std::string &where);
Json toJson(const InjectionExperiment &experiment);

/// What all trials of an experiment share: the recording, its background, the detectors' thresholds.
class InjectionTrials
{
public:
    /// Estimates the recording's noise, calibrates every detector, finds what signals there are and measures
    /// thresholds. Throws Error, Cancelled.
    InjectionTrials(const InjectionExperiment &experiment, RecordingPointer recording, const RunContext &context = {});
    ~InjectionTrials();

    /// The thresholds, one per detector.
    const std::vector<double> &thresholds() const { return m_thresholds; }

    /// Does the given trials on context.threads threads; run = trial, noise = [detector][0] without the line, signal =
    /// [detector][SNR][0] with it. Depends on nothing but the experiment and the recording.
    std::vector<RunOutcome> run(const std::vector<int> &trials, const RunContext &context = {},
                                const RunSink &sink = {}) const;

    /// The recording with one trial's line in it, and the line's truth.
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
