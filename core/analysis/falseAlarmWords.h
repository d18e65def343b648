#pragma once

#include <string>

namespace faintline {

/// How often false alarms come, in words with the interval the rate is known to, within `factor` either way: "one in
/// 1.1 h (0.9 to 1.4)", "25 an hour (20 to 31)", "one in 3.2 days (2.6 to 4)". Rates of one an hour and less are told
/// as the time between two, in hours, days or years.
std::string falseAlarmWords(double perHour, double factor);

} // namespace faintline
