#pragma once

#include "recording/FileBytes.h"

namespace faintline {

/// Whether the LIST or INFO chunk of a RIFF file holds a length with which libsndfile 1.2 (wavlike_subchunk_parse)
/// would leave it backwards, and might never come to an end: it adds them up in 32 bits. What describes photographs
/// (exif) counts as such, as it is not followed here, and no recorder writes it.
///
///   "LIST" size "INFO"|"adtl",  then again and again  name size content
bool leadsBackwards(const FileBytes &file, Index chunk);

} // namespace faintline
