#include "base/Field.h"

#include "base/Error.h"
#include "base/oneLine.h"

#include <cmath>

namespace faintline {

namespace {

    [[noreturn]] void refuse(const FieldInfo &info, std::string_view text, const std::string &why)
    {
        throw fieldError(info.name, std::string(text), why);
    }

    std::string rangeText(const FieldInfo &info)
    {
        std::string text = "must lie in " + formatNumber(info.minimum) + " … " + formatNumber(info.maximum);
        return info.unit.empty() ? text : text + " " + info.unit;
    }

    std::string orWords(const FieldInfo &info)
    {
        std::string text;
        for (const ValueWord &one : info.words)
            text += ", or \"" + one.word + "\"";
        return text;
    }

    std::string inLowerCase(std::string_view text)
    {
        std::string lower(text);
        for (char &c : lower)
            if (c >= 'A' && c <= 'Z')
                c = char(c - 'A' + 'a');
        return lower;
    }

    FieldValue valueOf(FieldKind kind, double number)
    {
        if (kind == FieldKind::Integer)
            return int(number);
        return kind == FieldKind::Numbers ? FieldValue(std::vector{number}) : FieldValue(number);
    }

    std::optional<FieldValue> parseWord(const FieldInfo &info, std::string_view text)
    {
        for (const ValueWord &one : info.words)
            if (inLowerCase(text) == one.word)
                return valueOf(info.kind, one.value);
        return std::nullopt;
    }

    std::optional<bool> parseFlag(std::string_view text)
    {
        if (text == "true" || text == "1" || text == "on" || text == "yes")
            return true;
        if (text == "false" || text == "0" || text == "off" || text == "no")
            return false;
        return std::nullopt;
    }

    /// A number or a quotient: "1/3".
    std::optional<double> parseQuotient(std::string_view text)
    {
        const std::size_t slash = text.find('/');
        if (slash == std::string_view::npos)
            return parseNumber(text);
        const std::optional<double> over = parseNumber(text.substr(0, slash));
        const std::optional<double> under = parseNumber(text.substr(slash + 1));
        return over && under && *under != 0.0 ? std::optional(*over / *under) : std::nullopt;
    }

    std::optional<std::vector<double>> parseNumbers(std::string_view text)
    {
        if (text.starts_with('[') && text.ends_with(']'))
            text = text.substr(1, text.size() - 2);
        std::vector<double> numbers;
        while (!text.empty()) {
            const std::size_t comma = text.find_first_of(",;");
            std::string_view word = text.substr(0, comma);
            while (word.starts_with(' '))
                word.remove_prefix(1);
            while (word.ends_with(' '))
                word.remove_suffix(1);
            const std::optional<double> number = parseQuotient(word);
            if (!number)
                return std::nullopt;
            numbers.push_back(*number);
            text = comma == std::string_view::npos ? std::string_view() : text.substr(comma + 1);
        }
        return numbers;
    }

} // namespace

std::string spelledOut(std::string_view camelCase)
{
    std::string words;
    for (const char c : camelCase)
        if (c >= 'A' && c <= 'Z')
            (words += words.empty() ? "" : " ") += char(c - 'A' + 'a');
        else
            words += c;
    return words;
}

std::string labelOf(const FieldInfo &info)
{
    if (!info.label.empty())
        return info.label;
    std::string words = spelledOut(std::string_view(info.name).substr(info.name.rfind('.') + 1));
    if (!words.empty() && words[0] >= 'a' && words[0] <= 'z')
        words[0] = char(words[0] - 'a' + 'A');
    return words;
}

std::string formatFieldValue(const FieldValue &value)
{
    struct Formatter {
        std::string operator()(bool v) const { return v ? "true" : "false"; }
        std::string operator()(int v) const { return std::to_string(v); }
        std::string operator()(double v) const { return formatNumber(v); }
        std::string operator()(const std::string &v) const { return v; }
        std::string operator()(const std::vector<double> &v) const { return listed(v, formatNumber); }
    };
    return std::visit(Formatter{}, value);
}

std::string wordOf(const FieldInfo &info, const FieldValue &value)
{
    for (const ValueWord &one : info.words)
        if (value == valueOf(info.kind, one.value))
            return one.word;
    return {};
}

std::string formatFieldValue(const FieldInfo &info, const FieldValue &value)
{
    const std::string word = wordOf(info, value);
    return word.empty() ? formatFieldValue(value) : word;
}

void checkFieldValue(const FieldInfo &info, const FieldValue &value)
{
    if (!wordOf(info, value).empty())
        return;
    const std::string text = formatFieldValue(value);
    const std::string orWord = orWords(info);
    const auto inRange = [&](double number) { return number >= info.minimum && number <= info.maximum; };
    switch (info.kind) {
    case FieldKind::Flag:
        if (!std::holds_alternative<bool>(value))
            refuse(info, text, "must be true or false");
        break;
    case FieldKind::Integer:
        if (!std::holds_alternative<int>(value) || !inRange(std::get<int>(value)))
            refuse(info, text, rangeText(info) + ", a whole number" + orWord);
        break;
    case FieldKind::Number:
        if (!std::holds_alternative<double>(value) || !inRange(std::get<double>(value)))
            refuse(info, text, rangeText(info) + orWord);
        break;
    case FieldKind::Numbers:
        if (!std::holds_alternative<std::vector<double>>(value))
            refuse(info, text, "must be a list of numbers" + orWord);
        for (double number : std::get<std::vector<double>>(value))
            if (!inRange(number))
                refuse(info, text, "each number " + rangeText(info) + orWord);
        break;
    case FieldKind::Choice: {
        bool known = false;
        if (std::holds_alternative<std::string>(value))
            for (const std::string &choice : info.choices)
                known = known || choice == std::get<std::string>(value);
        if (!known)
            refuse(info, text, "must be one of " + listed(info.choices));
        break;
    }
    }
}

Error fieldError(const std::string &name, const std::string &value, std::string why)
{
    return Error(name + " = " + value, std::move(why)).ofField(name);
}

FieldValue parseFieldValue(const FieldInfo &info, std::string_view text)
{
    if (const std::optional<FieldValue> named = parseWord(info, text))
        return *named;
    if ((info.kind == FieldKind::Number || info.kind == FieldKind::Integer) && hasDecimalComma(text))
        refuse(info, text, "has a decimal comma; write a decimal point");
    FieldValue value = std::string(text);
    switch (info.kind) {
    case FieldKind::Flag:
        if (const auto flag = parseFlag(text))
            value = *flag;
        break;
    case FieldKind::Integer:
        if (const auto number = parseNumber(text);
            number && std::floor(*number) == *number && std::abs(*number) < 2147483648.0)
            value = int(*number);
        break;
    case FieldKind::Number:
        if (const auto number = parseQuotient(text))
            value = *number;
        break;
    case FieldKind::Numbers:
        if (auto numbers = parseNumbers(text))
            value = std::move(*numbers);
        break;
    case FieldKind::Choice:
        break;
    }
    checkFieldValue(info, value);
    return value;
}

} // namespace faintline
