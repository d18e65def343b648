#pragma once

#include "base/json.h"
#include "scene/Fluctuation.h"
#include "signal/Recording.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

enum class Fading { None, Rayleigh };
inline constexpr std::array<std::string_view, 2> fadingNames{"none", "rayleigh"};

/// One spectral line. Its instantaneous frequency is
///
///   f(t) = frequencyHz + driftHzPerSecond·(t - startSeconds) + w(t)
///
/// with w a Gaussian Ornstein-Uhlenbeck process of autocorrelation wanderHz²·e^(-|τ|/wanderSeconds), its path shifted
/// and scaled to mean 0 and standard deviation exactly wanderHz. With Rayleigh fading the amplitude is multiplied by a
/// complex Ornstein-Uhlenbeck process of mean power 1 and correlation time fadingSeconds. With fluctuation the power is
/// multiplied by one value of mean 1 for the whole line (Swerling 1 and 3), or by one for each successive
/// referenceSeconds from its start (Swerling 2 and 4), with a continuous phase. Fading and fluctuation exclude each
/// other. Source: Billon 2005, section 5; Swerling 1954.
struct LineSettings {
    double snrDb = -1.0;            ///< r: see toneAmplitude
    double referenceSeconds = 0.25; ///< T: the window that r refers to
    double startSeconds = 0.0;
    double durationSeconds = 0.0; ///< 0: to the end of the recording
    double frequencyHz = 1000.0;  ///< at the start, centre frequency included
    double driftHzPerSecond = 0.0;
    double wanderHz = 0.0;
    double wanderSeconds = 3.75;
    Fading fading = Fading::None;
    double fadingSeconds = 5.0;
    Fluctuation fluctuation = Fluctuation::None;

    static const std::vector<Field<LineSettings>> &fields();
    bool operator==(const LineSettings &) const = default;
};

/// Gaussian noise. `deviation` is the standard deviation σ of a sample (complex: E|n|² = σ²). Its density changes with
/// |frequency| by slopeDbPerOctave and is flat below 1/1024 of half the sample rate. Its level drifts as an
/// Ornstein-Uhlenbeck process in dB, of standard deviation levelDriftDb and correlation time levelDriftSeconds.
struct NoiseSettings {
    double deviation = 0.1;
    double slopeDbPerOctave = 0.0;
    double levelDriftDb = 0.0;
    double levelDriftSeconds = 10.0;

    static const std::vector<Field<NoiseSettings>> &fields();
    bool operator==(const NoiseSettings &) const = default;
};

/// A scene to simulate: spectral lines in noise. Rate and duration have no default.
struct LineScene {
    double sampleRateHz = 0.0;
    double durationSeconds = 0.0;
    bool isComplex = false; ///< "complex" in JSON
    double centreHz = 0.0;  ///< frequency that corresponds to 0 Hz of the samples
    int seed = 1;
    NoiseSettings noise{};
    std::vector<LineSettings> lines{};

    /// The scene's own members, without noise and lines.
    static const std::vector<Field<LineScene>> &fields();
    bool operator==(const LineScene &) const = default;
};

/// Description of the scene's recording.
RecordingInfo recordingInfo(const LineScene &scene);

/// Checks a line's ranges, and that it lies within the recording and, apart from its wander, within the band. Throws
/// Error naming the key ("lines[2].snrDb" if `name` is "lines[2]").
void checkLine(const LineSettings &line, const RecordingInfo &recording, const std::string &name);

/// Checks each line as `checkLine` does, and their total memory; `name` is the list's name ("lines").
void checkLines(std::span<const LineSettings> lines, const RecordingInfo &recording, const std::string &name);

/// Checks the scene and its lines. Throws Error naming the key.
void checkScene(const LineScene &scene);

/// Reads a scene from {"kind": "lines", "sampleRateHz": …, "durationSeconds": …, "noise": {…}, "lines": [{…}]}. Unknown
/// keys are errors; missing ones take their defaults. Throws Error as checkScene does.
LineScene lineSceneFromJson(const Json &json);

Json toJson(const LineScene &scene);

} // namespace faintline
