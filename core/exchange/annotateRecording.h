#pragma once

#include <string>

namespace faintline {

/// Whether a path is the metadata of a SigMF recording.
bool isMetadataOf(const std::string &path, const std::string &recording);

/// Adds annotations, `sigmf` as `eventsSigmf` or `reviewedSigmf` makes it, to a SigMF recording's own metadata; all
/// else in it is kept. They take the place of annotations by Faintline of which no person has said anything: no verdict,
/// label or note, nor a member of their own. Those with words keep them, and get what the new run says of the same
/// place. Annotations by others are not added again. Returns how many were added. Throws Error.
int annotateRecording(const std::string &recording, const std::string &sigmf);

} // namespace faintline
