#pragma once

#include <string>

namespace faintline {

/// A text as one CSV field: quoted, quotes doubled.
std::string csvText(const std::string &text);

} // namespace faintline
