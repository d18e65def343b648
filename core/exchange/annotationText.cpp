#include "exchange/annotationText.h"

#include "base/oneLine.h"

#include <array>
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

} // namespace faintline
