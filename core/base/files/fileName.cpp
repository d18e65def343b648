#include "base/files/fileName.h"

#include "base/Error.h"
#include "base/oneLine.h"

#include <algorithm>
#include <filesystem>

namespace faintline {

namespace {

    /// Whether a character stands for a byte: U+10FE80 … U+10FEFF.
    bool isByte(std::string_view character)
    {
        return character.size() == 4 && character.starts_with("\xf4\x8f")
               && (static_cast<unsigned char>(character[2]) & 0xfe) == 0xba;
    }

} // namespace

std::string textFromFileName(std::string_view name)
{
    std::string text;
    for (std::size_t i = 0; i < name.size();) {
        const std::string_view character = name.substr(i, characterLength(name, i));
        if (!character.empty() && !isByte(character)) {
            text += character;
            i += character.size();
            continue;
        }
        const auto byte = static_cast<unsigned char>(name[i++]); // from 0x80 on
        text += {'\xf4', '\x8f', static_cast<char>(0xb8 | byte >> 6), static_cast<char>(0x80 | (byte & 0x3f))};
    }
    return text;
}

std::string fileNameFromText(std::string_view text)
{
    std::string name;
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view character = text.substr(i, std::max<std::size_t>(characterLength(text, i), 1));
        if (isByte(character))
            name += static_cast<char>((static_cast<unsigned char>(character[2]) & 3) << 6
                                      | (static_cast<unsigned char>(character[3]) & 0x3f));
        else
            name += character;
        i += character.size();
    }
    return name;
}

bool isFile(const std::string &path)
{
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

bool hasEnding(std::string_view path, std::string_view ending)
{
    const auto small = [](char letter) {
        return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    };
    return path.size() >= ending.size()
           && std::equal(ending.begin(), ending.end(), path.end() - std::ptrdiff_t(ending.size()),
                         [&](char a, char b) { return small(a) == small(b); });
}

void checkEnding(const std::string &path, const std::vector<std::string> &endings)
{
    std::string known;
    for (std::size_t i = 0; i < endings.size(); ++i) {
        if (hasEnding(path, endings[i]))
            return;
        known += (i == 0 ? "" : i + 1 == endings.size() ? " or " : ", ") + endings[i];
    }
    throw Error(path, "must end in " + known);
}

} // namespace faintline
