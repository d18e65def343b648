#pragma once

#include <string>

namespace faintline {

/// A rate of false alarms in words, with its confidence interval given by `factor`: "one in 1.1 h (0.9 to 1.4)", "25 an
/// hour (20 to 31)", "one in 3.2 days (2.6 to 4)". Rates of at most one per hour are given as the interval between
/// alarms, in hours, days or years.
std::string falseAlarmWords(double perHour, double factor);

} // namespace faintline
