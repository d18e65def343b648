#include "base/Axis.h"

namespace faintline {

Index Axis::nearest(double wanted) const
{
    if (count == 0)
        return 0;
    const double rounded = std::floor(position(wanted) + 0.5);
    const double last = double(count - 1);
    if (!cyclic)
        return Index(std::fmin(std::fmax(rounded, 0.0), last)); // these map NaN to 0
    if (!std::isfinite(rounded))
        return 0;
    const double rest = std::fmod(rounded, last + 1.0);
    return Index(rest < 0.0 ? rest + last + 1.0 : rest);
}

} // namespace faintline
