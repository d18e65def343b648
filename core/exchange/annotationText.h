#pragma once

#include "inspect/Review.h"

#include <string>

namespace faintline {

/// "label [rejected] note", for formats with a single text field. A note without a verdict follows "[]".
std::string annotationText(const std::string &label, Verdict verdict, const std::string &note);

/// Splits such a text; without brackets, all of it is the label.
void takeApart(const std::string &text, Annotation &annotation);

/// Whether a label or a SigMF comment is what Faintline writes of an event or area of which nobody has said anything
/// (eventsSigmf).
bool isEventLabel(const std::string &label);
bool isEventComment(const std::string &comment);

} // namespace faintline
