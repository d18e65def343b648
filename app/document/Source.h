#pragma once

#include "analysis/analyse.h"
#include "app/document/FrameKind.h"
#include "recording/InjectedRecording.h"
#include "recording/LineScene.h"
#include "recording/PingScene.h"
#include "recording/PingTruth.h"
#include "recording/Recording.h"
#include "recording/Truth.h"
#include "recording/openRecording.h"
#include "spectrum/NormalisedFrames.h"

#include <QString>

#include <cstdint>
#include <optional>
#include <vector>

namespace faintline {

/// Origin of samples or frames: a file and how to read it, or a scene to simulate.
struct Source {
    QString path;                     ///< of the recording, the stack of frames (.npy) or the scenario
    OpenOptions options;              ///< of a recording
    std::optional<LineScene> scene;   ///< set: simulated
    std::optional<PingScene> pings{}; ///< set: a sonar's pings, simulated

    /// Lines added to it, one after the other, each with its own seed.
    struct Injection {
        InjectedLine line;
        int channel = 0;
        std::uint64_t seed = 1;
    };
    std::vector<Injection> injections{};

    /// Name for window titles: the file's label.
    QString name() const;
    bool isSimulated() const { return scene || pings; }
    /// Whether it is a stack of ready-made frames, a NumPy file.
    bool isStack() const;
};

/// An opened source: a recording, or frames ready for the detector.
struct OpenedSource {
    Source source;
    RecordingPointer recording;
    Truth truth; ///< of a simulated recording, or in a file beside a recording; with the lines added
    NormalisedFramesPointer frames{};
    PingTruth pingTruth{}; ///< of simulated pings, or in a file beside pings

    const FrameKind &kind() const { return frames ? frameKindOf(frames->grid()) : lineFrames(); }
};

/// The source that a path denotes: a scenario for a JSON file, frames for a NumPy file, otherwise a recording. Throws
/// Error.
Source sourceOf(const QString &path, const OpenOptions &options = {});

/// Opens or simulates. Throws Error.
OpenedSource openSource(const Source &source);

/// Initial settings for a source.
AnalysisSettings firstSettings(const OpenedSource &opened);

/// Runs the pipeline on an opened source.
std::shared_ptr<const Analysis> analyse(const OpenedSource &opened, const AnalysisSettings &settings,
                                        const RunContext &context = {}, const Analysis *previous = nullptr,
                                        const PictureSink &pictures = {},
                                        CalibrationDepth depth = CalibrationDepth::Refined);

/// The open source with one more line. Throws Error.
OpenedSource withInjection(const OpenedSource &opened, const Source::Injection &injection);

/// Whether a file holds raw samples whose type and rate must be specified before it can be opened.
bool needsRawOptions(const QString &path, const OpenOptions &options);

} // namespace faintline
