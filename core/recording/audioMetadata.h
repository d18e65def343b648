#pragma once

#include "recording/AudioDecoder.h"
#include "recording/Recording.h"
#include "recording/Stretches.h"

namespace faintline {

/// Container and sample type of a libsndfile format in plain words: "WAV", "int16".
std::string containerName(int format);
std::string sampleTypeName(int format);

/// Fills in what the header says of when and at which frequency it was recorded: bext (origination date and time
/// reference), auxi (a receiver's start time and centre frequency), harp (XWAV's start times), or a date string that is
/// an ISO 8601 time. Answers where the file's samples lie in time, which only harp tells.
Stretches readAudioMetadata(const AudioDecoder &decoder, RecordingInfo &info);

/// The number of bytes, as libsndfile's log tells, by which a header claims more than the file holds; 0 if it does not.
long long missingBytes(const std::string &log);

/// Whether an AIFF file's sample rate, an 80-bit floating-point number, lies in 1 Hz … 2³⁰ Hz. The library makes one up
/// where it does not.
bool hasAiffRate(const FileBytes &file);

} // namespace faintline
