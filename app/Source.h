#pragma once

#include "recording/InjectedRecording.h"
#include "recording/LineScene.h"
#include "recording/Recording.h"
#include "recording/Truth.h"
#include "recording/openRecording.h"

#include <QString>

#include <cstdint>
#include <optional>
#include <vector>

namespace faintline {

/// Where samples come from: a file and how to read it, or a scene to simulate.
struct Source {
    QString path;                   ///< of the recording or the scenario
    OpenOptions options;            ///< of a recording
    std::optional<LineScene> scene; ///< set: simulated

    /// Lines added to it, one after the other, each with a seed of its own.
    struct Injection {
        InjectedLine line;
        int channel = 0;
        std::uint64_t seed = 1;
    };
    std::vector<Injection> injections;

    /// What a window title says.
    QString name() const;
};

/// A source that has been opened.
struct OpenedSource {
    Source source;
    RecordingPointer recording;
    Truth truth; ///< of a simulated one, and of injected lines
};

/// The source a path stands for: a scenario where it names a JSON file, otherwise a recording. Throws Error.
Source sourceOf(const QString &path, const OpenOptions &options = {});

/// Opens or simulates. Throws Error.
OpenedSource openSource(const Source &source);

/// What is open with one more line in it. Throws Error.
OpenedSource withInjection(const OpenedSource &opened, const Source::Injection &injection);

/// Whether a file holds bare samples, so that their type and rate have to be asked for before it can be opened.
bool needsRawOptions(const QString &path, const OpenOptions &options);

} // namespace faintline
