#pragma once

#include "base/RunContext.h"
#include "recording/Recording.h"

#include <string>

namespace faintline {

enum class WrittenType { Float32, Int16 };

/// Throws Error where writeRecording does not know a file name's extension.
void checkRecordingName(const std::string &path);

/// Writes a recording to a file, its kind by the extension: .wav (RF64 where it gets larger than 4 GB), .rf64, .w64,
/// .aiff, .caf, .au, .flac (float samples as 24 bits), or a SigMF pair (.sigmf-meta or .sigmf-data).
///
/// Complex samples take two channels, I and Q, except in SigMF. Integers are round(x·2^(bits-1)), clipped at full
/// scale. Files appear only when complete; cancelled, nothing is left behind. The same recording gives the same bytes.
/// Start time goes into WAV and RF64 (bext) and SigMF, the centre frequency into SigMF only. Returns how many numbers
/// were clipped. Throws Error where the kind cannot hold the recording or the disk is full, Cancelled where the context
/// says so.
Index writeRecording(const Recording &recording, const std::string &path, WrittenType type = WrittenType::Float32,
                     const RunContext &context = {});

} // namespace faintline
