#pragma once

#include "analysis/Review.h"
#include "recording/Recording.h"

#include <string>
#include <vector>

namespace faintline {

/// Reads annotations of another program, or of this one: Raven selection tables (columns by their names), Audacity
/// labels (with or without frequencies), SigMF annotations, and the CSV and JSON that `writeReviewed` and `writeEvents`
/// write. Which it is, the content tells.
///
/// Times are in seconds from the first sample; frequencies as the program has them everywhere else, of I/Q recordings
/// offsets from the centre, which `info` knows. A text "label [rejected] note" is taken apart. At most 100 000
/// annotations of a file of at most 64 MiB; broken or hostile content throws Error naming file and line.
std::vector<Annotation> readAnnotations(const std::string &path, const RecordingInfo &info);

} // namespace faintline
