#pragma once

#include "analysis/Review.h"

#include <string>

namespace faintline {

/// Writes events with what was said about them, and the boxes somebody drew; the kind by the extension: .csv, .json,
/// .selections.txt (Raven selection table), .txt (Audacity labels with frequencies), .sigmf-meta.
///
/// Columns and keys are those of `writeEvents`, then f_low, f_high (Hz, what the track fills; on one axis only), review
/// (accepted, rejected or nothing), signal (the number of the first event of the same one), label (the event's class,
/// else "event 3"), note. A box has no event number. Where a format has one text only it reads
/// "label [rejected] note"; `readAnnotations` reads all of them back. Throws Error as `writeEvents` does.
void writeReviewed(const Analysis &analysis, const std::vector<Event> &events, const Annotations &annotations,
                   const std::string &path);

/// Throws Error if `writeReviewed` does not know the extension of a name.
void checkReviewedPath(const std::string &path);

} // namespace faintline
