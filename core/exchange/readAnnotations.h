#pragma once

#include "inspect/Review.h"
#include "recording/Recording.h"

#include <string>
#include <vector>

namespace faintline {

/// Reads annotations of this or another program: Raven selection tables (columns by name), Audacity labels (with or
/// without frequencies), SigMF annotations, and the CSV and JSON of `writeReviewed` and `writeEvents`. The format is
/// recognised by content.
///
/// Times are in seconds since the first sample. Frequencies are as elsewhere in the program; for I/Q recordings they
/// are relative to the centre, which `info` gives. A text "label [rejected] note" is split. At most 100 000 annotations
/// of a file of at most 64 MiB; invalid or hostile content throws Error naming file and line.
std::vector<Annotation> readAnnotations(const std::string &path, const RecordingInfo &info);

} // namespace faintline
