#include "base/readableNumber.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace faintline {

namespace {

    /// The shortest form that reads back the same.
    std::string shortestForm(double value, std::chars_format format)
    {
        std::array<char, 64> buffer;
        const auto [end, code] =
            std::to_chars(buffer.data(), buffer.data() + buffer.size(), value == 0.0 ? 0.0 : value, format);
        return code == std::errc() ? std::string(buffer.data(), end) : "nan";
    }

} // namespace

std::string formatPlainly(double value)
{
    const double size = std::abs(value);
    return shortestForm(value, size >= 1e-4 && size < 1e15 ? std::chars_format::fixed : std::chars_format::general);
}

std::string formatToStep(double value, double step, int leastDigits)
{
    const auto placeOf = [](double number) { return int(std::floor(std::log10(std::abs(number)))); };
    if (value == 0.0 || !std::isfinite(value))
        return shortestForm(value, std::chars_format::general);
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
    if (point.starts_with('+'))
        point.erase(0, 1);
    double value = 0.0;
    const char *const last = point.data() + point.size();
    const auto [end, code] = std::from_chars(point.data(), last, value);
    return code == std::errc() && end == last;
}

} // namespace faintline
