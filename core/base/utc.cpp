#include "base/utc.h"

#include "base/Field.h"

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace faintline {

namespace {

    /// Removes `digits` decimal digits from the front of a text.
    std::optional<int> takeDigits(std::string_view &text, std::size_t digits)
    {
        int value = 0;
        if (text.size() < digits || text.front() == '-' || text.front() == '+')
            return std::nullopt;
        const auto [end, code] = std::from_chars(text.data(), text.data() + digits, value);
        if (code != std::errc() || end != text.data() + digits)
            return std::nullopt;
        text.remove_prefix(digits);
        return value;
    }

    bool take(std::string_view &text, std::string_view anyOf)
    {
        if (text.empty() || anyOf.find(text.front()) == std::string_view::npos)
            return false;
        text.remove_prefix(1);
        return true;
    }

    std::optional<double> takeFraction(std::string_view &text)
    {
        if (!take(text, ".,"))
            return 0.0;
        const std::size_t length = std::min(text.find_first_not_of("0123456789"), text.size());
        const std::optional<double> fraction = parseNumber("0." + std::string(text.substr(0, length)));
        text.remove_prefix(length);
        return length > 0 ? fraction : std::nullopt;
    }

    /// Seconds east of Greenwich: "Z", "", "+02:00", "-0530", "+02".
    std::optional<int> takeZone(std::string_view text)
    {
        if (text.empty() || text == "Z" || text == "z")
            return 0;
        const int sign = text.front() == '-' ? -1 : 1;
        if (!take(text, "+-"))
            return std::nullopt;
        const std::optional<int> hours = takeDigits(text, 2);
        take(text, ":");
        const std::optional<int> minutes = text.empty() ? 0 : takeDigits(text, 2);
        if (!hours || !minutes || !text.empty())
            return std::nullopt;
        return sign * (*hours * 3600 + *minutes * 60);
    }

} // namespace

std::optional<double> unixSeconds(int year, int month, int day, const TimeOfDay &time)
{
    using namespace std::chrono;
    const auto [hour, minute, second] = time;
    const year_month_day date{std::chrono::year{year}, std::chrono::month{unsigned(month)},
                              std::chrono::day{unsigned(day)}};
    // A leap second (60) reads as the first one of the next minute.
    if (!date.ok() || hour < 0 || hour > 23 || minute < 0 || minute > 59 || !(second >= 0.0 && second < 61.0))
        return std::nullopt;
    const auto days = sys_days(date).time_since_epoch().count();
    return double(days) * 86400.0 + hour * 3600.0 + minute * 60.0 + second;
}

std::optional<double> parseUtc(std::string_view text)
{
    const auto year = takeDigits(text, 4);
    take(text, "-");
    const auto month = year ? takeDigits(text, 2) : std::nullopt;
    take(text, "-");
    const auto day = month ? takeDigits(text, 2) : std::nullopt;
    if (!day || !take(text, "Tt "))
        return std::nullopt;
    const auto hour = takeDigits(text, 2);
    take(text, ":");
    const auto minute = hour ? takeDigits(text, 2) : std::nullopt;
    take(text, ":");
    const auto second = minute ? takeDigits(text, 2) : std::nullopt;
    const auto fraction = second ? takeFraction(text) : std::nullopt;
    if (!fraction)
        return std::nullopt;
    while (text.starts_with(' '))
        text.remove_prefix(1);
    const auto zone = takeZone(text);
    const auto local = unixSeconds(*year, *month, *day, {*hour, *minute, *second + *fraction});
    return zone && local ? std::optional(*local - *zone) : std::nullopt;
}

std::string formatUtc(double unixSeconds)
{
    using namespace std::chrono;
    if (!(std::abs(unixSeconds) < 2e11)) // years -4000 … 8000, NaN
        return {};
    const auto micro = static_cast<long long>(std::floor(unixSeconds * 1e6 + 0.5));
    const sys_time<microseconds> time{microseconds(micro)};
    const auto days = floor<std::chrono::days>(time);
    const year_month_day date(days);
    const hh_mm_ss clock(time - days);
    std::array<char, 64> buffer;
    std::snprintf(buffer.data(), buffer.size(), "%04d-%02u-%02uT%02d:%02d:%02d.%06d", int(date.year()),
                  unsigned(date.month()), unsigned(date.day()), int(clock.hours().count()),
                  int(clock.minutes().count()), int(clock.seconds().count()), int(clock.subseconds().count()));
    std::string result(buffer.data());
    result.erase(result.find_last_not_of('0') + 1);
    if (result.ends_with('.'))
        result.pop_back();
    return result + "Z";
}

} // namespace faintline
