#pragma once

#include "signal/fileFormats.h"

#include <string>
#include <vector>

namespace faintline {

/// Opens a recording: a folder or list as many files (Timeline); raw samples if rawType is given; else by the first of
/// `fileFormats` that recognises the file. Start time and centre frequency that a file does not tell are taken from its
/// name. Reads headers only. Throws Error{path, cause and what would be accepted}.
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
