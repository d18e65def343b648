#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace faintline {

/// Converts an ISO 8601 date and time ("2024-07-26T00:00:00.25Z", "… +02:00") to seconds since 1970-01-01T00:00:00 UTC.
/// A space may replace the T; without a zone the time is UTC. Returns nothing if the text is not a time.
std::optional<double> parseUtc(std::string_view text);

/// Formats a time as ISO 8601, to the microsecond, without trailing zeros of the fraction: "2024-07-26T00:00:00.25Z".
std::string formatUtc(double unixSeconds);

struct TimeOfDay {
    int hour = 0;
    int minute = 0;
    double second = 0.0;
};

/// Seconds since 1970-01-01 of a calendar date and time; nothing if they do not exist.
std::optional<double> unixSeconds(int year, int month, int day, const TimeOfDay &time = {});

} // namespace faintline
