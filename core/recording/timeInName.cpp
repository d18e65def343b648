#include "recording/timeInName.h"

#include "base/utc.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <regex>
#include <utility>

namespace faintline {

namespace {

    constexpr const char *timeOfDay =
        R"([T_ -]?(\d{2})[:._-]?(\d{2})[:._-]?(\d{2})(?:[.,](\d{3}|\d{6}))?(?:([+-])(\d{2}):?(\d{2}))?(?!\d))";

    double numberIn(const std::smatch &match, std::size_t group)
    {
        return match[group].matched ? std::stod(match[group].str()) : 0.0;
    }

    std::optional<double> calendarTime(const std::smatch &match)
    {
        const double year = numberIn(match, 1) + (match[1].length() == 2 ? 2000.0 : 0.0);
        const double fraction = numberIn(match, 7) / std::pow(10.0, double(match[7].length()));
        const double zone =
            (match[8].str() == "-" ? -1.0 : 1.0) * 60.0 * (60.0 * numberIn(match, 9) + numberIn(match, 10));
        const auto time =
            unixSeconds(int(year), int(numberIn(match, 2)), int(numberIn(match, 3)),
                        {int(numberIn(match, 4)), int(numberIn(match, 5)), numberIn(match, 6) + fraction});
        return time && year >= 1970.0 && year < 2100.0 ? std::optional(*time - zone) : std::nullopt;
    }

    std::optional<double> countedTime(const std::smatch &match)
    {
        constexpr double latest = 4102444800.0; // 2100
        const double time = numberIn(match, 1) / (match[1].length() == 13 ? 1e3 : 1.0);
        return time >= 1e9 && time < latest ? std::optional(time) : std::nullopt;
    }

    struct Pattern {
        std::regex regex;
        std::optional<double> (*timeOf)(const std::smatch &match);
    };

    const std::array<Pattern, 4> &patterns()
    {
        static const std::array<Pattern, 4> table{{
            {std::regex(std::string(R"((?:^|\D)(\d{4})-?(\d{2})-?(\d{2}))") + timeOfDay), calendarTime},
            {std::regex(std::string(R"((?:^|\D)(\d{2})-?(\d{2})-?(\d{2}))") + timeOfDay), calendarTime},
            {std::regex(R"((?:^|\D)(\d{10})(?!\d))"), countedTime},
            {std::regex(R"((?:^|\D)(\d{13})(?!\d))"), countedTime},
        }};
        return table;
    }

} // namespace

std::optional<double> timeInName(const std::string &path)
{
    const std::string name = std::filesystem::path(path).filename().string();
    for (const Pattern &pattern : patterns())
        for (auto match = std::sregex_iterator(name.begin(), name.end(), pattern.regex);
             match != std::sregex_iterator(); ++match)
            if (const std::optional<double> time = pattern.timeOf(*match))
                return time;
    return std::nullopt;
}

double unixFromGps(double gps)
{
    constexpr double gpsEpoch = 315964800.0; // 1980-01-06 in seconds since 1970
    constexpr std::array<std::pair<double, int>, 4> leaps{
        {{1167264018.0, 18}, {1119744017.0, 17}, {1025136016.0, 16}, {914803215.0, 15}}};
    int leap = 14;
    for (auto since = leaps.rbegin(); since != leaps.rend(); ++since)
        if (gps >= since->first)
            leap = since->second;
    return gps + gpsEpoch - leap;
}

double unixFromGpsWeekSecond(double secondOfWeek, double about)
{
    constexpr double week = 604800.0;
    return unixFromGps(secondOfWeek + week * std::round((about - unixFromGps(secondOfWeek)) / week));
}

} // namespace faintline
