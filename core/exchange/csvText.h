#pragma once

#include <string>

namespace faintline {

/// A text as one field of a CSV file: quoted, quotes doubled.
std::string csvText(const std::string &text);

} // namespace faintline
