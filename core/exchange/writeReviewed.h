#pragma once

#include "inspect/Review.h"

#include <string>

namespace faintline {

/// Writes events with their reviews, and manually drawn boxes; the extension selects the format: .csv, .json,
/// .selections.txt (Raven selection table), .txt (Audacity labels with frequencies), .sigmf-meta.
///
/// Columns and keys are those of `writeEvents`, then f_low, f_high (Hz, extent of the track; on one axis only), review
/// (accepted, rejected or nothing), signal (the number of the same signal's first event), label (the event's class,
/// else "event 3"), note. A box has no event number. Formats with a single text field hold "label [rejected] note";
/// `readAnnotations` reads all of them back. Throws Error as `writeEvents` does.
void writeReviewed(const Analysis &analysis, const std::vector<Event> &events, const Annotations &annotations,
                   const std::string &path);

/// The text of such a .json file.
std::string reviewedJson(const Analysis &analysis, const std::vector<Event> &events, const Annotations &annotations);

/// The text of such a .sigmf-meta file. Throws Error for frames.
std::string reviewedSigmf(const Analysis &analysis, const std::vector<Event> &events, const Annotations &annotations);

/// Throws Error if `writeReviewed` does not know the extension of a name.
void checkReviewedPath(const std::string &path);

} // namespace faintline
