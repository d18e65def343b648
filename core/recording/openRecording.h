#pragma once

#include "recording/Recording.h"

#include <string>

namespace faintline {

/// How to read a file whose content does not say it all.
struct OpenOptions {
    bool iq = false;        ///< take real channels in pairs, as I and Q of one complex channel
    std::string rawType;    ///< datatype of a raw file, SigMF's names ("ci16_le", "rf32_be", "cu8" …); empty: not raw
    double rawRateHz = 0.0; ///< sample rate of a raw file
    int rawChannels = 1;
    Index rawHeaderBytes = 0;
};

/// Opens a recording: of many files where a folder or a list is named (Timeline); raw where rawType is given; SigMF by
/// either of its two names; a KiwiSDR's WAV; GWOSC's strain; else any format that libsndfile recognises, by content;
/// else, where the extension is one of raw samples (".cf32", ".cs16" …), a raw file of that type, for which the rate
/// must be given. Reads no more than headers. Throws Error{path, what is wrong and what would be accepted}.
RecordingPointer openRecording(const std::string &path, const OpenOptions &options = {});

/// SHA-256 of the recording's data file as lower-case hexadecimal digits; of its first and last mebibyte and its length
/// where it is larger than 64 MiB, so that opening stays quick ("part:" stands before such a hash).
std::string recordingHash(const std::string &path);

} // namespace faintline
