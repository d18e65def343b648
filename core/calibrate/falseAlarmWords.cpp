#include "calibrate/falseAlarmWords.h"

#include <cmath>
#include <cstdio>

namespace faintline {

namespace {

    std::string twoDigits(double value)
    {
        char text[32];
        if (value >= 10.0)
            std::snprintf(text, sizeof text, "%.0f", value);
        else
            std::snprintf(text, sizeof text, "%.2g", value);
        return text;
    }

} // namespace

std::string falseAlarmWords(double perHour, double factor)
{
    constexpr double hoursPerDay = 24.0;
    constexpr double hoursPerYear = 8766.0;
    if (!(perHour > 0.0) || !std::isfinite(perHour))
        return "none";
    const auto interval = [&](double middle) {
        return " (" + twoDigits(middle / factor) + " to " + twoDigits(middle * factor) + ")";
    };
    if (perHour > 1.0 + 1e-9)
        return twoDigits(perHour) + " per hour" + interval(perHour);
    const double hours = 1.0 / perHour;
    const double unit = hours < 2.0 * hoursPerDay ? 1.0 : hours < hoursPerYear ? hoursPerDay : hoursPerYear;
    const char *name = unit == 1.0 ? " h" : unit == hoursPerDay ? " days" : " years";
    return "one in " + twoDigits(hours / unit) + name + interval(hours / unit);
}

} // namespace faintline
