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

/// Where samples or frames come from: a file and how to read it, or a scene to simulate.
struct Source {
    QString path;                     ///< of the recording, the stack of frames (.npy) or the scenario
    OpenOptions options;              ///< of a recording
    std::optional<LineScene> scene;   ///< set: simulated
    std::optional<PingScene> pings{}; ///< set: a sonar's pings, simulated

    /// Lines added to it, one after the other, each with a seed of its own.
    struct Injection {
        InjectedLine line;
        int channel = 0;
        std::uint64_t seed = 1;
    };
    std::vector<Injection> injections{};

    /// What a window title says: the file's name as a label shows it.
    QString name() const;
    bool isSimulated() const { return scene || pings; }
    /// Whether it is a stack of ready-made frames, a NumPy file.
    bool isStack() const;
};

/// A source that has been opened: a recording, or frames that are ready for the detector.
struct OpenedSource {
    Source source;
    RecordingPointer recording;
    Truth truth; ///< of a simulated one, and of injected lines
    NormalisedFramesPointer frames{};
    PingTruth pingTruth{}; ///< of simulated pings

    const FrameKind &kind() const { return frames ? frameKindOf(frames->grid()) : lineFrames(); }
};

/// The source a path stands for: a scenario where it names a JSON file, frames where a NumPy file, otherwise a
/// recording. Throws Error.
Source sourceOf(const QString &path, const OpenOptions &options = {});

/// Opens or simulates. Throws Error.
OpenedSource openSource(const Source &source);

/// What one looks at a source with before having chosen anything.
AnalysisSettings firstSettings(const OpenedSource &opened);

/// The pipeline on whatever was opened.
std::shared_ptr<const Analysis> analyse(const OpenedSource &opened, const AnalysisSettings &settings,
                                        const RunContext &context = {}, const Analysis *previous = nullptr,
                                        const PictureSink &pictures = {},
                                        CalibrationDepth depth = CalibrationDepth::Refined);

/// What is open with one more line in it. Throws Error.
OpenedSource withInjection(const OpenedSource &opened, const Source::Injection &injection);

/// Whether a file holds bare samples, so that their type and rate have to be asked for before it can be opened.
bool needsRawOptions(const QString &path, const OpenOptions &options);

} // namespace faintline
