#include "base/oneLine.h"

namespace faintline {

namespace {

    std::string trimmed(const std::string &text)
    {
        const std::size_t first = text.find_first_not_of(' ');
        return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(' ') - first + 1);
    }

    /// Bytes of the UTF-8 character that begins there; 0 where none does.
    std::size_t characterLength(const std::string &text, std::size_t at)
    {
        const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
        const unsigned first = byte(at);
        const std::size_t length = first < 0x80 ? 1 : first >= 0xc2 && first < 0xe0 ? 2 : (first & 0xf0) == 0xe0 ? 3 : first >= 0xf0 && first < 0xf5 ? 4 : 0;
        for (std::size_t i = 1; i < length; ++i)
            if ((byte(at + i) & 0xc0) != 0x80)
                return 0;
        // Overlong forms, surrogates, and beyond the last character.
        const unsigned second = byte(at + 1);
        const bool isForbidden = (first == 0xe0 && second < 0xa0) || (first == 0xed && second >= 0xa0) || (first == 0xf0 && second < 0x90)
                                 || (first == 0xf4 && second >= 0x90);
        return isForbidden ? 0 : length;
    }

    /// The beginning of a character at or before a byte.
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
        return text.substr(0, boundary(text, half)) + " … " + text.substr(boundary(text, text.size() - half));
    }

} // namespace

std::string oneLine(const std::string &text, std::size_t mostBytes)
{
    std::string line;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = characterLength(text, i);
        if (length <= 1) {
            const char c = text[i++];
            const auto code = static_cast<unsigned char>(c);
            line += length == 0 ? '?' : code < 0x20 || code == 0x7f ? ' ' : c;
            continue;
        }
        line += text.substr(i, length);
        i += length;
    }
    return shortened(trimmed(line), mostBytes);
}

} // namespace faintline
