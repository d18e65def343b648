#include "exchange/annotationText.h"

#include "base/oneLine.h"

#include <array>
#include <regex>
#include <utility>

namespace faintline {

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
    annotation.label = oneLine(text.substr(0, first));
    annotation.note = first == std::string::npos ? std::string() : oneLine(text.substr(first + length));
}

bool isEventLabel(const std::string &label)
{
    static const std::regex pattern(R"(event \d{1,10}( \(of \d{1,10}\))?|area)");
    return std::regex_match(label, pattern);
}

bool isEventComment(const std::string &comment)
{
    static const std::regex pattern(R"(statistic [-+.e\d]{1,30} (nat|× noise)(, SNR [-+.e\d]{1,30} dB in one window)?)"
                                    R"(|not a line: level raised by at least [-+.e\d]{1,30} dB)");
    return std::regex_match(comment, pattern);
}

} // namespace faintline
