#pragma once

#include "analysis/Review.h"

#include <string>

namespace faintline {

/// "label [rejected] note": what a format with one text for everything holds. A note without a verdict comes after
/// "[]".
std::string annotationText(const std::string &label, Verdict verdict, const std::string &note);

/// Takes such a text apart; one without brackets is all label.
void takeApart(const std::string &text, Annotation &annotation);

} // namespace faintline
