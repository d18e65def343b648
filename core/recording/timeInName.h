#pragma once

#include <optional>
#include <string>

namespace faintline {

/// Start time of a recording, as recorders write it into file names; seconds since 1970, UTC.
///
///   20260123_235959   2026-01-23T23:59:59Z   20260123T235959+0100   20260123235959.125   year to second
///   260123_235959     260123235959                                                        the same for 2000 … 2099
///   1769212799        1769212799123                                                       seconds, milliseconds
///
/// A T, _, - or blank separates date and time; a fraction has 3 or 6 digits; without a zone the time is UTC. The first
/// matching pattern of this table counts. Returns nothing if the name (without its folders) holds no such time.
std::optional<double> timeInName(const std::string &path);

/// The time nearest to `about` that lies `secondOfWeek` seconds after the start of a GPS week; seconds since 1970, UTC.
double unixFromGpsWeekSecond(double secondOfWeek, double about);

/// Converts GPS time (seconds since 1980-01-06, counting leap seconds) to seconds since 1970.
double unixFromGps(double gps);

} // namespace faintline
