#pragma once

#include "signal/Recording.h"
#include "signal/Stretches.h"
#include "signal/formats/AudioDecoder.h"

namespace faintline {

/// Container and sample type of a libsndfile format: "WAV", "int16".
std::string containerName(int format);
std::string sampleTypeName(int format);

/// Sets start time and centre frequency from the header: a recorder's comment or GUANO time stamp with its zone, bext
/// (origination date and time reference), auxi (a receiver's start time and centre frequency), harp (XWAV's start
/// times), or a date string that is an ISO 8601 time. A date that is later than the time in the file's name by the
/// recording's length was written at its end. Returns the places of the file's samples in time, which only harp gives.
Stretches readAudioMetadata(const AudioDecoder &decoder, RecordingInfo &info);

/// Number of bytes by which a header claims more than the file holds, according to libsndfile's log; 0 if it does not.
long long missingBytes(const std::string &log);

/// Whether an AIFF file's sample rate, an 80-bit floating-point number, lies in 1 Hz … 2³⁰ Hz. The library invents one
/// if it does not.
bool hasAiffRate(const FileBytes &file);

} // namespace faintline
