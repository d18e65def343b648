#pragma once

#include <optional>
#include <string>

namespace faintline {

/// When a recording began, as recorders write it into the names of files; seconds since 1970, UTC.
///
///   20260123_235959   2026-01-23T23:59:59Z   20260123T235959+0100   20260123235959.125   year to second
///   260123_235959     260123235959                                                        the same of 2000 … 2099
///   1769212799        1769212799123                                                       seconds, milliseconds
///
/// Between date and time stand T, _, - or a blank; a fraction has 3 or 6 digits; without a zone it is UTC. The first
/// pattern of this table that fits counts. Nothing where the name (without its folders) holds no such time.
std::optional<double> timeInName(const std::string &path);

/// The moment nearest to `about` that lies so many seconds behind the start of a GPS week; seconds since 1970, UTC.
double unixFromGpsWeekSecond(double secondOfWeek, double about);

/// Seconds since 1970 of a GPS time (seconds since 1980-01-06, leap seconds counted).
double unixFromGps(double gps);

} // namespace faintline
