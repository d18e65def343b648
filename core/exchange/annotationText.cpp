#include "exchange/annotationText.h"

#include <array>
#include <utility>

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

} // namespace

std::string oneLine(const std::string &text)
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
    return trimmed(line);
}

std::string annotationText(const std::string &label, Verdict verdict, const std::string &note)
{
    std::string text = label;
    if (verdict != Verdict::None || !note.empty())
        text += (text.empty() ? "[" : " [") + nameOf(verdict) + "]";
    return note.empty() ? text : text + " " + note;
}

void takeApart(const std::string &text, Annotation &annotation)
{
    constexpr std::array<std::pair<const char *, Verdict>, 3> marks{
        {{"[accepted]", Verdict::Accepted}, {"[rejected]", Verdict::Rejected}, {"[]", Verdict::None}}};
    std::size_t first = std::string::npos;
    std::size_t length = 0;
    for (const auto &[mark, verdict] : marks)
        if (const std::size_t at = text.find(mark); at < first) {
            first = at;
            length = std::string(mark).size();
            annotation.verdict = verdict;
        }
    annotation.label = trimmed(text.substr(0, first));
    annotation.note = first == std::string::npos ? std::string() : trimmed(text.substr(first + length));
}

} // namespace faintline
