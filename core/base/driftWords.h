#pragma once

#include <string>

namespace faintline {

/// Unit in which drifts are displayed, and its size in Hz/s.
struct DriftUnit {
    const char *name = "Hz/s";
    double hzPerSecond = 1.0;
};

/// kHz/s, Hz/s, mHz/s or µHz/s, suited to drifts up to the given one; Hz/s if it is 0 or NaN.
DriftUnit driftUnit(double largestHzPerSecond);

/// A drift with two digits and its unit: "50 µHz/s".
std::string driftWords(double hzPerSecond);

} // namespace faintline
