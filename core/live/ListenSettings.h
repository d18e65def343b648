#pragma once

#include "live/SigmfRecorder.h"
#include "plan/AnalysisSettings.h"

#include <cstddef>
#include <string>

namespace faintline {

/// Settings of a live run.
struct ListenSettings {
    /// The background is always causal; a window of 0 s is replaced by that for a recording of one hour.
    AnalysisSettings analysis;
    std::string recordPath; ///< .sigmf-meta of the recording to write; empty: none
    RotationSettings rotation;
    double updateSeconds = 10.0; ///< between two reports of an event in progress
    /// Capacity for samples waiting to be analysed; at most 4 MiB for a source that can wait.
    std::size_t bufferBytes = std::size_t(64) << 20;
};

/// An incident in the stream or in its recording, as opposed to a detected event.
struct ListenNotice {
    enum class Kind { Started, Lost, Overflow, Gone, Back, Drift, DiskSpace, RecordingFailed, Refused, Stopped };

    Kind kind = Kind::Started;
    Index sample = 0;      ///< position since the first sample, gaps included
    Index sampleCount = 0; ///< samples lost, or by which the clocks differ
    std::string words;     ///< one sentence
};

} // namespace faintline
