#include "detect/Detector.h"

#include <algorithm>
#include <cstdlib>

namespace faintline {

bool CellBox::contains(const Grid &grid, const std::vector<Index> &coordinates) const
{
    for (std::size_t axis = 0; axis < grid.axes.size(); ++axis) {
        const Axis &a = grid.axes[axis];
        Index distance = std::abs(coordinates[axis] - centre[axis]);
        if (a.cyclic)
            distance = std::min(distance, a.count - distance);
        if (distance > halfWidth[axis])
            return false;
    }
    return true;
}

} // namespace faintline
