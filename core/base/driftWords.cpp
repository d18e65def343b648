#include "base/driftWords.h"

#include <cmath>
#include <cstdio>

namespace faintline {

DriftUnit driftUnit(double largestHzPerSecond)
{
    if (largestHzPerSecond >= 1e4)
        return {"kHz/s", 1e3};
    if (largestHzPerSecond >= 0.1 || !(largestHzPerSecond > 0.0))
        return {"Hz/s", 1.0};
    if (largestHzPerSecond >= 1e-4)
        return {"mHz/s", 1e-3};
    return {"µHz/s", 1e-6};
}

std::string driftWords(double hzPerSecond)
{
    const DriftUnit unit = driftUnit(std::abs(hzPerSecond));
    const double value = hzPerSecond / unit.hzPerSecond;
    char text[48];
    if (std::abs(value) >= 10.0)
        std::snprintf(text, sizeof text, "%.0f %s", value, unit.name);
    else
        std::snprintf(text, sizeof text, "%.2g %s", value, unit.name);
    return text;
}

} // namespace faintline
