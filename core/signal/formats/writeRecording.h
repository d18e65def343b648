#pragma once

#include "base/RunContext.h"
#include "signal/Recording.h"

#include <string>

namespace faintline {

enum class WrittenType { Float32, Int16 };

/// Throws Error if writeRecording does not know the file name's extension.
void checkRecordingName(const std::string &path);

/// Writes a recording to a file; the extension selects the format: .wav (RF64 if larger than 4 GB), .rf64, .w64, .aiff,
/// .caf, .au, .flac (float samples as 24 bits), or a SigMF pair (.sigmf-meta or .sigmf-data).
///
/// Complex samples take two channels, I and Q, except in SigMF. Integers are round(x·2^(bits-1)), clipped at full
/// scale. Files appear only when complete; cancelling leaves nothing behind. The same recording gives the same bytes.
/// WAV and RF64 (bext) and SigMF store the start time; only SigMF stores the centre frequency. Returns the number of
/// clipped values. Throws Error if the format cannot hold the recording or the disk is full, Cancelled if the context
/// requests it.
Index writeRecording(const Recording &recording, const std::string &path, WrittenType type = WrittenType::Float32,
                     const RunContext &context = {});

} // namespace faintline
