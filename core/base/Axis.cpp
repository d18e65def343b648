#include "base/Axis.h"

#include <algorithm>

namespace faintline {

Index Axis::nearest(double wanted) const
{
    if (count == 0)
        return 0;
    const double rounded = std::floor(position(wanted) + 0.5);
    if (cyclic) {
        const double n = static_cast<double>(count);
        return static_cast<Index>(rounded - n * std::floor(rounded / n));
    }
    return static_cast<Index>(std::clamp(rounded, 0.0, static_cast<double>(count - 1)));
}

} // namespace faintline
