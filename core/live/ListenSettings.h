#pragma once

#include "analysis/AnalysisSettings.h"
#include "live/SigmfRecorder.h"

#include <cstddef>
#include <string>

namespace faintline {

/// How a source is listened to.
struct ListenSettings {
    /// Its background is causal, whatever is set; a window of 0 is one for an hour's recording.
    AnalysisSettings analysis;
    std::string recordPath; ///< .sigmf-meta of the recording to be made; empty: none
    RotationSettings rotation;
    double updateSeconds = 10.0; ///< between two reports of an event in progress
    /// Of samples that wait to be analysed; at most 4 MiB of a source that waits.
    std::size_t bufferBytes = std::size_t(64) << 20;
};

/// Something that happened to the samples, not in them.
struct ListenNotice {
    enum class Kind { Started, Lost, Overflow, Gone, Back, Drift, DiskSpace, RecordingFailed, Refused, Stopped };

    Kind kind = Kind::Started;
    Index sample = 0;      ///< where in time, from the first sample on, gaps included
    Index sampleCount = 0; ///< how many it is about: those that were lost, by which clocks differ
    std::string words;     ///< one sentence
};

} // namespace faintline
