#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace faintline {

/// Seconds since 1970-01-01T00:00:00 UTC of an ISO 8601 date and time ("2024-07-26T00:00:00.25Z", "… +02:00"; a space
/// may stand for the T, no zone means UTC); nothing if the text is not a time.
std::optional<double> parseUtc(std::string_view text);

/// ISO 8601, to the microsecond, trailing zeros of the fraction left out: "2024-07-26T00:00:00.25Z".
std::string formatUtc(double unixSeconds);

struct TimeOfDay {
    int hour = 0;
    int minute = 0;
    double second = 0.0;
};

/// Seconds since 1970-01-01 of a calendar date and time; nothing if there is no such day or time.
std::optional<double> unixSeconds(int year, int month, int day, const TimeOfDay &time = {});

} // namespace faintline
