#pragma once

#include "recording/FileBytes.h"

namespace faintline {

/// Whether a LIST or INFO chunk of a RIFF file holds a length that would make libsndfile 1.2 (wavlike_subchunk_parse),
/// which adds lengths in 32 bits, seek backwards and possibly loop forever. Chunks for photographs (exif) count as
/// such: they are not parsed here, and no recorder writes them.
///
///   "LIST" size "INFO"|"adtl",  then repeatedly  name size content
bool leadsBackwards(const FileBytes &file, Index chunk);

} // namespace faintline
