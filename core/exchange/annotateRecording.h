#pragma once

#include <string>

namespace faintline {

/// Whether a path is the metadata of a SigMF recording.
bool isMetadataOf(const std::string &path, const std::string &recording);

/// Adds annotations, `sigmf` as `eventsSigmf` or `reviewedSigmf` makes it, to a SigMF recording's own metadata; all
/// else in it is kept. An annotation of the same place and label is not added again, but replaced if Faintline made it.
/// Returns how many were added. Throws Error.
int annotateRecording(const std::string &recording, const std::string &sigmf);

} // namespace faintline
