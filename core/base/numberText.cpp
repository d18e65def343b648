#include "base/numberText.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace faintline {

namespace {

    /// `form`: none for the shorter one, or that of std::to_chars.
    template <class... Form>
    std::string shortest(double value, Form... form)
    {
        if (value == 0.0)
            return "0"; // -0 as well
        std::array<char, 64> buffer;
        const auto [end, code] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, form...);
        return code == std::errc() ? std::string(buffer.data(), end) : std::string("nan");
    }

} // namespace

std::string formatNumber(double value)
{
    return shortest(value);
}

std::string formatPlainly(double value)
{
    const double size = std::abs(value);
    return size >= 1e-4 && size < 1e15 ? shortest(value, std::chars_format::fixed) : formatNumber(value);
}

std::string formatToStep(double value, double step, int leastDigits)
{
    const auto placeOf = [](double number) { return int(std::floor(std::log10(std::abs(number)))); };
    if (value == 0.0 || !std::isfinite(value))
        return formatNumber(value);
    int digits = std::max(leastDigits, std::min(placeOf(value) + 1, 15));
    if (step > 0.0 && std::isfinite(step))
        digits = std::max(digits, placeOf(value) - placeOf(step / 10.0) + 1);
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", std::min(digits, 17), value);
    return text;
}

std::optional<double> parseNumber(std::string_view text)
{
    double value = 0.0;
    if (text.starts_with('+') && !text.starts_with("+-"))
        text.remove_prefix(1);
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size() || text.empty())
        return std::nullopt;
    return value;
}

bool hasDecimalComma(std::string_view text)
{
    std::string point(text);
    const std::size_t comma = point.find(',');
    if (comma == std::string::npos)
        return false;
    point[comma] = '.';
    return parseNumber(point).has_value();
}

} // namespace faintline
