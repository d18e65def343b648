#include "base/readableNumber.h"

#include "base/Field.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace faintline {

std::string formatPlainly(double value)
{
    const double size = std::abs(value);
    if (!(size >= 1e-4 && size < 1e15))
        return formatNumber(value);
    std::array<char, 64> buffer;
    const auto [end, code] =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
    return code == std::errc() ? std::string(buffer.data(), end) : formatNumber(value);
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
