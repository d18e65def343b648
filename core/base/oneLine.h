#pragma once

#include <string>
#include <string_view>

namespace faintline {

/// On one line and valid UTF-8, without tabs and other control characters, those of bidirectional text included: what
/// goes into a row of a table, into a message, to a terminal or onto a label. Of more than `mostBytes` the middle is
/// left out, "…".
std::string oneLine(const std::string &text, std::size_t mostBytes = std::string::npos);

/// Bytes of the UTF-8 character that begins there; 0 where none does.
std::size_t characterLength(std::string_view text, std::size_t at);

/// As long as a message may be, whatever is in the file that it tells of.
constexpr std::size_t longestMessage = 1000;

} // namespace faintline
