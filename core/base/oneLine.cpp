#include "base/oneLine.h"

#include <algorithm>

namespace faintline {

std::size_t characterLength(std::string_view text, std::size_t at)
{
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const unsigned first = byte(at);
    const std::size_t length = first < 0x80                    ? 1
                               : first >= 0xc2 && first < 0xe0 ? 2
                               : (first & 0xf0) == 0xe0        ? 3
                               : first >= 0xf0 && first < 0xf5 ? 4
                                                               : 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(at + i) & 0xc0) != 0x80)
            return 0;
    // Overlong forms, surrogates, and beyond the last character.
    const unsigned second = byte(at + 1);
    const bool isForbidden = (first == 0xe0 && second < 0xa0) || (first == 0xed && second >= 0xa0)
                             || (first == 0xf0 && second < 0x90) || (first == 0xf4 && second >= 0x90);
    return isForbidden ? 0 : length;
}

namespace {

    /// Control characters for terminals, and characters that change the order of text: C0 and C1, the marks,
    /// embeddings, overrides and isolates of bidirectional text, and the line and paragraph separators. They have up to
    /// three bytes.
    bool isControl(std::string_view character)
    {
        const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
        if (character.size() == 1)
            return byte(0) < 0x20 || byte(0) == 0x7f;
        if (character.size() == 2) // U+0080 … U+009F, U+061C
            return (byte(0) == 0xc2 && byte(1) < 0xa0) || character == "\xd8\x9c";
        if (character.size() != 3 || byte(0) != 0xe2)
            return false;
        if (byte(1) == 0x80) // U+200E, U+200F, U+2028 … U+202E
            return byte(2) == 0x8e || byte(2) == 0x8f || (byte(2) >= 0xa8 && byte(2) <= 0xae);
        return byte(1) == 0x81 && byte(2) >= 0xa6 && byte(2) <= 0xa9; // U+2066 … U+2069
    }

    std::string trimmed(const std::string &text)
    {
        const std::size_t first = text.find_first_not_of(' ');
        return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(' ') - first + 1);
    }

    /// Start of a character at or before a byte.
    std::size_t boundary(const std::string &text, std::size_t at)
    {
        while (at > 0 && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80)
            --at;
        return at;
    }

    std::string shortened(const std::string &text, std::size_t mostBytes)
    {
        if (text.size() <= mostBytes)
            return text;
        const std::size_t half = mostBytes / 2;
        return beginning(text, half) + " … " + text.substr(boundary(text, text.size() - half));
    }

} // namespace

std::string beginning(const std::string &text, std::size_t mostBytes)
{
    return mostBytes >= text.size() ? text : text.substr(0, boundary(text, mostBytes));
}

std::string oneLine(const std::string &text, std::size_t mostBytes)
{
    std::string line;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = characterLength(text, i);
        const std::string_view character = std::string_view(text).substr(i, std::max<std::size_t>(length, 1));
        line += length == 0 ? std::string_view("?") : isControl(character) ? std::string_view(" ") : character;
        i += character.size();
    }
    return shortened(trimmed(line), mostBytes);
}

} // namespace faintline
