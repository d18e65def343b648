#pragma once

#include "signal/openRecording.h"

#include <string>
#include <vector>

namespace faintline {

/// Opens files, folders and lists as one recording (Timeline). Throws Error.
RecordingPointer openTogether(const std::vector<std::string> &names, const OpenOptions &options = {});

} // namespace faintline
