#pragma once

#include <string>

namespace faintline {

/// The unit that drifts are written in, and what it is in Hz/s.
struct DriftUnit {
    const char *name = "Hz/s";
    double hzPerSecond = 1.0;
};

/// kHz/s, Hz/s, mHz/s or µHz/s, for drifts up to that one; Hz/s where it is 0 or no number.
DriftUnit driftUnit(double largestHzPerSecond);

/// Two digits of a drift with its unit: "50 µHz/s".
std::string driftWords(double hzPerSecond);

} // namespace faintline
