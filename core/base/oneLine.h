#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace faintline {

/// Converts text to one line of valid UTF-8 without tabs and other control characters, including bidirectional ones,
/// for table rows, messages, terminals and labels. If it is longer than `mostBytes`, its middle is replaced by "…".
std::string oneLine(const std::string &text, std::size_t mostBytes = std::string::npos);

/// First characters of UTF-8 text, at most `mostBytes` bytes; no character is cut.
std::string beginning(const std::string &text, std::size_t mostBytes);

/// Length in bytes of the UTF-8 character that begins at `at`; 0 if none does.
std::size_t characterLength(std::string_view text, std::size_t at);

/// The words that a function, or a member, makes of each, as "a, b, c"; by default each itself.
template <class Range, class WordOf = std::identity>
std::string listed(const Range &range, const WordOf &wordOf = {}, std::string_view separator = ", ")
{
    std::string list;
    bool isFirst = true;
    for (const auto &one : range) {
        list += isFirst ? std::string_view() : separator;
        list += std::invoke(wordOf, one);
        isFirst = false;
    }
    return list;
}

/// Maximum length of a message in bytes, whatever a file contains.
constexpr std::size_t longestMessage = 1000;

} // namespace faintline
