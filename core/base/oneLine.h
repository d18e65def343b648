#pragma once

#include <string>

namespace faintline {

/// On one line and valid UTF-8, without tabs and other control characters: what goes into a row of a table or into a message. Of more than
/// `mostBytes` the middle is left out, "…".
std::string oneLine(const std::string &text, std::size_t mostBytes = std::string::npos);

/// As long as a message may be, whatever is in the file that it tells of.
constexpr std::size_t longestMessage = 1000;

} // namespace faintline
