#pragma once

#include "recording/LineScene.h"
#include "recording/Recording.h"
#include "recording/Truth.h"
#include "recording/openRecording.h"

#include <QString>

#include <optional>

namespace faintline {

/// Where samples come from: a file and how to read it, or a scene to simulate.
struct Source {
    QString path;                   ///< of the recording or the scenario
    OpenOptions options;            ///< of a recording
    std::optional<LineScene> scene; ///< set: simulated

    /// What a window title says.
    QString name() const;
};

/// A source that has been opened.
struct OpenedSource {
    Source source;
    RecordingPointer recording;
    Truth truth; ///< of a simulated one
};

/// The source a path stands for: a scenario where it names a JSON file, otherwise a recording. Throws Error.
Source sourceOf(const QString &path, const OpenOptions &options = {});

/// Opens or simulates. Throws Error.
OpenedSource openSource(const Source &source);

/// Whether a file holds bare samples, so that their type and rate have to be asked for before it can be opened.
bool needsRawOptions(const QString &path, const OpenOptions &options);

} // namespace faintline
