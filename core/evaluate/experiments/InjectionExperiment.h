#pragma once

#include "base/json.h"
#include "evaluate/experiments/LineExperiment.h"
#include "plan/AnalysisSettings.h"

#include <cstddef>
#include <string>
#include <vector>

namespace faintline {

/// Detection of known lines added to a real recording: Pd in this noise.
///
/// A *trial* adds one line at a random time and frequency of the selection, away from all signals, and tests for each
/// detector whether its statistic exceeds its threshold within half a resolution cell of the line while it lasts; for a
/// detector that decides at the end of blocks, which are placed as in the whole recording, also at the first end after
/// the line. All trials count for all detectors. One that is `detect` as a whole analyses the line's surroundings,
/// `marginSeconds` before and after it, in the selected band.
///
/// Everything that the chain of any detector tracks at a thousandth of the specified false-alarm rate counts as a
/// signal and is removed for all detectors alike (y = 0). Thresholds give each detector the same number of false alarms
/// in the rest of this recording (measuredThreshold), counted in blocks as long as a line and 12 resolution cells wide,
/// with the statistic used in the trials.
struct InjectionExperiment {
    std::string recording{}; ///< path, as text (base/files/fileName.h)
    bool iq = false;         ///< two channels as I and Q
    int seed = 1;
    int trials = 200;
    std::vector<double> snrDb{-3.0, 0.0, 3.0}; ///< in a rectangular window of T_FT, over the noise at the line's place
    double durationSeconds = 60.0;
    double driftHzPerSecond = 0.0;
    double wanderHz = 0.0;
    double wanderSeconds = 10.0;
    double falseAlarmsPerHour = 1.0;
    double marginSeconds = 60.0;                ///< before and after a line, for `detect` as a whole
    AnalysisSettings settings{};                ///< selection, spectrogram and noise, the same for all detectors
    std::vector<DetectorUnderTest> detectors{}; ///< their model and detector override these

    static const std::vector<Field<InjectionExperiment>> &fields();
    bool operator==(const InjectionExperiment &) const = default;
};

/// {"kind": "injection", "recording": …, "settings": {…}, "detectors": [{"name": …, "settings": {…}}], …}; throws
/// Error.
InjectionExperiment injectionExperimentFromJson(const Json &json, const std::string &where);
Json toJson(const InjectionExperiment &experiment);

/// Settings of one detector: its model and detector settings with all shared ones.
AnalysisSettings settingsOf(const InjectionExperiment &experiment, std::size_t detector);

} // namespace faintline
