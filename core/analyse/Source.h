#pragma once

#include "base/json.h"
#include "frames/NormalisedFrames.h"
#include "noise/openFrames.h"
#include "plan/AnalysisSettings.h"
#include "scene/InjectedRecording.h"
#include "scene/LineScene.h"
#include "scene/PingScene.h"
#include "scene/PingTruth.h"
#include "scene/Truth.h"
#include "signal/Recording.h"
#include "signal/openRecording.h"

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace faintline {

/// Origin of samples or frames: a file and how to read it, or a scene to simulate.
struct Source {
    std::string path;                 ///< of the recording, the stack of frames (.npy) or the scene
    OpenOptions options;              ///< of a recording
    std::optional<LineScene> scene;   ///< set: simulated
    std::optional<PingScene> pings{}; ///< set: a sonar's pings, simulated

    /// Lines added to it, one after the other, each with its own seed.
    struct Injection {
        InjectedLine line;
        int channel = 0;
        std::uint64_t seed = 1;
        bool operator==(const Injection &) const = default;
    };
    std::vector<Injection> injections{};

    bool operator==(const Source &) const = default;

    bool isSimulated() const { return scene || pings; }
    /// Whether it is a stack of ready-made frames, a NumPy file.
    bool isStack() const;
    /// Whether it opens as a recording, not as frames.
    bool hasSamples() const;
};

/// An opened source: a recording, or frames ready for the detector.
struct OpenedSource {
    OpenedSource() = default;

    template <std::convertible_to<RecordingPointer> Pointer>
    OpenedSource(Pointer samples) : recording(std::move(samples))
    {
    }

    template <std::convertible_to<NormalisedFramesPointer> Pointer>
    OpenedSource(Pointer readyMade) : frames(std::move(readyMade))
    {
    }

    Source source; ///< without a path: what was opened elsewhere, and is analysed as it is
    RecordingPointer recording;
    Truth truth; ///< of a simulated recording, or in a file beside a recording; with the lines added
    NormalisedFramesPointer frames{};
    PingTruth pingTruth{};         ///< of simulated pings, or in a file beside pings
    FramesOptions normalisation{}; ///< with which the frames of a file were normalised
    bool isPower = false;          ///< frames made from the power in a file, which the settings may normalise anew

    /// Whether they are frames on several axes from a file, which the settings may normalise anew.
    bool isRecordedPings() const
    {
        return frames && !frames->grid().isSpectrum() && !source.isSimulated() && !source.path.empty();
    }

    /// Whether these settings ask for the frames as they are.
    bool isNormalisedFor(const AnalysisSettings &settings) const;
    /// The frames at hand, or, if the settings ask for another normalisation, those.
    NormalisedFramesPointer framesFor(const AnalysisSettings &settings, const RunContext &context) const;
};

/// The source that a path denotes: a scene for a JSON file, otherwise a file that is not read yet. Throws Error.
Source sourceOf(const std::string &path, const OpenOptions &options = {});

/// The source of a scene's JSON, which `path` names. Throws Error.
Source sourceOfScene(const Json &scene, const std::string &path);

/// How settings normalise the frames of a file.
FramesOptions normalisationBy(const AnalysisSettings &settings);

/// Opens or simulates, with the truth beside the file; recorded pings and power are normalised. Throws Error,
/// Cancelled.
OpenedSource openSource(const Source &source, const FramesOptions &normalisation = {}, const RunContext &context = {});

/// Only the samples, with the lines added. Throws Error for frames.
RecordingPointer openSamples(const Source &source);

/// The open source with one more line. Throws Error.
OpenedSource withInjection(const OpenedSource &opened, const Source::Injection &injection);

} // namespace faintline
