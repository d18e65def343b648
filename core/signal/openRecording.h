#pragma once

#include "signal/Recording.h"

#include <string>
#include <vector>

namespace faintline {

/// How to read a file that does not fully describe itself.
struct OpenOptions {
    bool iq = false;        ///< take real channels in pairs, as I and Q of one complex channel
    std::string rawType;    ///< datatype of a raw file, SigMF's names ("ci16_le", "rf32_be", "cu8" …); empty: not raw
    double rawRateHz = 0.0; ///< sample rate of a raw file
    int rawChannels = 1;
    Index rawHeaderBytes = 0;

    bool operator==(const OpenOptions &) const = default;
};

/// Opens a recording: a folder or list as many files (Timeline); raw samples if rawType is given; SigMF by either of
/// its two names; KiwiSDR WAV; GWOSC strain; else any format that libsndfile recognises by content; else a raw file if
/// its extension denotes a raw sample type (".cf32", ".cs16" …), for which the rate must be given, here or by the
/// name. Start time and centre frequency that a file does not tell are taken from its name. Reads headers only.
/// Throws Error{path, cause and what would be accepted}.
RecordingPointer openRecording(const std::string &path, const OpenOptions &options = {});

/// The options with type and rate of raw samples completed as a receiver's program wrote them into the file's name
/// (receiverName); openRecording does this.
OpenOptions withNamedFormat(const std::string &path, OpenOptions options);

/// SHA-256 of the recording's data file as lower-case hexadecimal digits. For files larger than 64 MiB, only the first
/// and last mebibyte and the length are hashed, so that opening stays fast; such a hash begins with "part:".
std::string recordingHash(const std::string &path);

/// Opens files, folders and lists as one recording (Timeline). Throws Error.
RecordingPointer openTogether(const std::vector<std::string> &names, const OpenOptions &options = {});

} // namespace faintline
