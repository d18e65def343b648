#pragma once

#include "base/json.h"
#include "plan/AnalysisSettings.h"
#include "scene/LineScene.h"
#include "signal/Recording.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// A detector in an experiment, with its settings.
struct DetectorUnderTest {
    std::string name;
    AnalysisSettings settings; ///< model and detector are used; the spectrogram is the experiment's
    /// `detect` as a whole, from samples to tracks, with all these settings except selection and false alarms, which
    /// are the experiment's. Its statistic is the margin of a track over the threshold (lineDetection.h).
    bool isWhole = false;

    bool operator==(const DetectorUnderTest &) const = default;
};

/// Detection of known lines in simulated white noise or in a recording: by several detectors against SNR, or by
/// `detect` against one number, a setting or a property of the line.
///
/// *Lines*, as in Billon 2005 section 5: a *run* is a field of `frames` × `bins` cells of white noise, evaluated alone
/// and with one line in each of its blocks of `blockFrames` × `blockBins` cells. All lines of a run have the same SNR,
/// duration and wander; onset, frequency and phase are random. A window T_FT lasts one second, so that seconds are
/// windows, and Hz are resolution cells.
///
/// *Injection*: Pd in the noise of a recording. A run adds one line at a random time and frequency of the selection,
/// away from all signals, and tests for each detector whether its statistic exceeds its threshold within half a
/// resolution cell of the line while it lasts; for a detector that decides at the end of blocks, which are placed as in
/// the whole recording, also at the first end after the line. All runs count for all detectors. One that is `detect` as
/// a whole analyses the line's surroundings, `marginSeconds` before and after it, in the selected band.
/// Everything that the chain of any detector tracks at a thousandth of the specified false-alarm rate counts as a
/// signal and is removed for all detectors alike (y = 0). Thresholds give each detector the same number of false alarms
/// in the rest of this recording (measuredThreshold), counted in blocks as long as a line and 12 resolution cells wide,
/// with the statistic used in the trials.
///
/// *Sweep*: performance of `detect`, from samples to tracks, for different values of one number. A *trial* is a stretch
/// of noise with one line in its middle, in simulated white noise or added to a recording: `marginSeconds` before it,
/// the line, and `marginSeconds` after it. All values use the same trials, so that differences are not due to chance. A
/// window that the settings leave open is chosen in each trial. A track that detects the line (lineDetection.h) gives
/// its latency; one that never touches it is a false alarm. In a recording, existing signals also count as false
/// alarms. Runs cycle through the values: run = trial · values + value, so half of the runs give half of the trials of
/// each value.
struct Experiment {
    enum class Kind { Lines, Injection, Sweep };
    static constexpr std::array<std::string_view, 3> kindNames{"lines", "injection", "sweep"};
    static constexpr int windowSamples = 250; ///< of Lines

    Kind kind = Kind::Lines;
    std::string recording{}; ///< path, as text (base/files/fileName.h); empty: simulated white noise
    bool iq = false;         ///< two channels as I and Q
    int seed = 1;
    int trials = 20; ///< fields of Lines; injected lines; lines on which every value of a sweep is tried
    int frames = 2000;
    int blockFrames = 300;
    int blockBins = 200;
    int stepsPerWindow = 2; ///< k_t
    int binsPerCell = 4;    ///< k_f
    WindowShape window = WindowShape::Rectangular;
    /// In a rectangular window of T_FT or the automatic T0, over the noise at the line's place; a sweep has one.
    std::vector<double> snrDb{-1.0};
    double durationSeconds = 100.0;
    double driftHzPerSecond = 0.0;
    double wanderHz = 0.0; ///< standard deviation of the wander
    double wanderSeconds = 15.0;
    Fading fading = Fading::None;
    double fadingSeconds = 20.0;
    Fluctuation fluctuation = Fluctuation::None; ///< Swerling 2 and 4: from window to window
    double falseAlarmsPerHour = 1.0;
    double marginSeconds = 20.0;                ///< before and after a line, for `detect` as a whole
    double sampleRateHz = 1000.0;               ///< of a sweep's simulated noise
    AnalysisSettings settings{};                ///< selection, spectrogram and noise of all detectors; all of a sweep's
    std::vector<DetectorUnderTest> detectors{}; ///< of Lines and Injection; their model and detector override these
    std::string parameter{};                    ///< of a sweep: "model.snr", or "snrDb" or another number of the line
    std::vector<double> values{};

    /// With the defaults of its kind.
    static Experiment of(Kind kind);
    static const std::vector<Field<Experiment>> &fields(Kind kind);
    bool operator==(const Experiment &) const = default;

    bool isLines() const { return kind == Kind::Lines; }
    bool isSweep() const { return kind == Kind::Sweep; }

    int bins() const { return windowSamples * binsPerCell; }
    int blocksInTime() const { return frames / blockFrames; }
    int blocksInFrequency() const { return bins() / blockBins; }
    int signalsPerRun() const { return blocksInTime() * blocksInFrequency(); }
    int signalFrames() const;

    double trialSeconds() const { return durationSeconds + 2.0 * marginSeconds; } ///< of a sweep
    int runs() const { return isSweep() ? trials * int(values.size()) : trials; }
    int valueOf(int run) const { return run % int(values.size()); }
    int trialOf(int run) const { return run / int(values.size()); }
};

/// `steps` values from `from` to `to`, evenly spaced or at a constant ratio; integers if the setting is one, without
/// duplicates. Throws Error.
std::vector<double> sweepValues(const std::string &parameter, double from, double to, int steps, bool isLogarithmic);

/// Whether a setting can be swept: it holds one number.
bool isSweepable(const FieldInfo &field);

/// The properties of the line that can be varied: snrDb, durationSeconds, driftHzPerSecond, wanderHz, wanderSeconds.
const std::vector<Field<Experiment>> &lineProperties();

/// What is varied: a setting, or a property of the line. Throws Error.
const FieldInfo &parameterInfo(const std::string &parameter);

/// A sweep with one of its values, in its settings or its line. Throws Error if they are invalid.
Experiment experimentAt(const Experiment &sweep, std::size_t value);

/// Settings of one detector of an injection: its model and detector settings with all shared ones.
AnalysisSettings settingsOf(const Experiment &injection, std::size_t detector);

/// A line of the experiment that begins at 0 s and 0 Hz; its SNR, in a window of `referenceSeconds`.
LineSettings lineOf(const Experiment &experiment, double snrDb, double referenceSeconds);

/// Throws Error naming the key.
void checkExperiment(const Experiment &experiment, const std::string &where = {});

/// Reads an experiment by its "kind"; throws Error.
///   {"kind": "lines", "snrDb": […], …, "detectors": [{"name": …, "settings": {…}, "whole": false}]}
///   {"kind": "injection", "recording": …, "settings": {…}, "detectors": […], …}
///   {"kind": "sweep", "parameter": "model.snr", "values": […] or {"from": …, "to": …, "steps": …, "scale": "linear" or
///    "log"}, "settings": {…}, …}
Experiment experimentFromJson(const Json &json, const std::string &where);
Json toJson(const Experiment &experiment);

/// Reads the number of a run; throws Error naming `where`.
int runFromJson(const Json &json, const Experiment &experiment, const std::string &where);

/// The name of an experiment's recording; empty if its noise is simulated.
std::string recordingOf(const Experiment &experiment);

/// Opens the recording that an experiment names; null if its noise is simulated. Throws Error.
RecordingPointer openRecordingOf(const Experiment &experiment);

} // namespace faintline
