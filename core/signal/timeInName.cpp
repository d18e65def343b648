#include "signal/timeInName.h"

#include "base/utc.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <regex>
#include <utility>

namespace faintline {

namespace {

    constexpr const char *timeOfDay =
        R"([T_ -]?(\d{2})[:._-]?(\d{2})[:._-]?(\d{2})(?:[.,](\d{3}|\d{6})|[_-](\d{3})(?! ?[kMG]?Hz))?)"
        R"((?:([+-])(\d{2}):?(\d{2}))?(?!\d))";

    double numberIn(const std::smatch &match, std::size_t group)
    {
        return match[group].matched ? std::stod(match[group].str()) : 0.0;
    }

    std::optional<NamedTime> calendarTime(const std::smatch &match)
    {
        const double year = numberIn(match, 1) + (match[1].length() == 2 ? 2000.0 : 0.0);
        const std::size_t behind = match[8].matched ? 8 : 7; // digits behind the second
        const double fraction = numberIn(match, behind) / std::pow(10.0, double(match[behind].length()));
        const double zone =
            (match[9].str() == "-" ? -1.0 : 1.0) * 60.0 * (60.0 * numberIn(match, 10) + numberIn(match, 11));
        const auto time =
            unixSeconds(int(year), int(numberIn(match, 2)), int(numberIn(match, 3)),
                        {int(numberIn(match, 4)), int(numberIn(match, 5)), numberIn(match, 6) + fraction});
        return time && year >= 1970.0 && year < 2100.0 ? std::optional(NamedTime{*time - zone, match[behind].matched})
                                                       : std::nullopt;
    }

    /// Hour to second, then day to year, as SDR++ writes them.
    std::optional<NamedTime> reversedTime(const std::smatch &match)
    {
        const auto time = unixSeconds(int(numberIn(match, 6)), int(numberIn(match, 5)), int(numberIn(match, 4)),
                                      {int(numberIn(match, 1)), int(numberIn(match, 2)), numberIn(match, 3)});
        return time ? std::optional(NamedTime{*time, false}) : std::nullopt;
    }

    std::optional<NamedTime> countedTime(const std::smatch &match)
    {
        constexpr double latestUnixSeconds = 4102444800.0; // 2100
        const bool hasFraction = match[1].length() == 13;
        const double time = numberIn(match, 1) / (hasFraction ? 1e3 : 1.0);
        return time >= 1e9 && time < latestUnixSeconds ? std::optional(NamedTime{time, hasFraction}) : std::nullopt;
    }

    struct Pattern {
        std::regex regex;
        std::optional<NamedTime> (*timeOf)(const std::smatch &match);
    };

    const std::array<Pattern, 5> &patterns()
    {
        static const std::array<Pattern, 5> table{{
            {std::regex(std::string(R"((?:^|\D)(\d{4})-?(\d{2})-?(\d{2}))") + timeOfDay), calendarTime},
            {std::regex(std::string(R"((?:^|\D)(\d{2})-?(\d{2})-?(\d{2}))") + timeOfDay), calendarTime},
            {std::regex(R"((?:^|\D)(\d{2})-(\d{2})-(\d{2})_(\d{2})-(\d{2})-(\d{4})(?!\d))"), reversedTime},
            {std::regex(R"((?:^|\D)(\d{10})(?! ?[kMG]?Hz|\d))", std::regex::icase), countedTime},
            {std::regex(R"((?:^|\D)(\d{13})(?!\d))"), countedTime},
        }};
        return table;
    }

} // namespace

std::optional<NamedTime> stampInName(const std::string &path)
{
    const std::string name = std::filesystem::path(path).filename().string();
    for (const Pattern &pattern : patterns())
        for (auto match = std::sregex_iterator(name.begin(), name.end(), pattern.regex);
             match != std::sregex_iterator(); ++match)
            if (const std::optional<NamedTime> time = pattern.timeOf(*match))
                return time;
    return std::nullopt;
}

std::optional<double> timeInName(const std::string &path)
{
    const std::optional<NamedTime> stamp = stampInName(path);
    return stamp ? std::optional(stamp->unixSeconds) : std::nullopt;
}

std::optional<ReceiverName> receiverName(const std::string &path)
{
    static const std::regex gqrx(R"(gqrx_\d{8}_\d{6}_(\d{1,15})_(\d{1,12})_fc\.raw)", std::regex::icase);
    static const std::regex others(
        R"((SDRSharp|HDSDR|SDRuno|SDRconnect|baseband)_(?:.*_)?(\d{1,15})(k|M)?Hz(?:_(.*))?\.wav)", std::regex::icase);
    const std::string name = std::filesystem::path(path).filename().string();
    std::smatch match;
    if (std::regex_match(name, match, gqrx) && numberIn(match, 2) > 0.0)
        return ReceiverName{"gqrx", numberIn(match, 1), numberIn(match, 2), "cf32_le"};
    if (!std::regex_match(name, match, others) || match[4].str().starts_with("AF"))
        return std::nullopt;
    const std::string unit = match[3].str();
    const double scale = unit.empty() ? 1.0 : unit == "k" || unit == "K" ? 1e3 : 1e6;
    return ReceiverName{match[1].str() == "baseband" ? "SDR++" : match[1].str(), scale * numberIn(match, 2), 0.0, {}};
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
