#include "base/CellBox.h"

#include <algorithm>
#include <cstdlib>

namespace faintline {

bool CellBox::contains(const Grid &grid, const std::vector<Index> &coordinates) const
{
    for (std::size_t i = 0; const Axis &axis : grid.axes) {
        Index distance = std::abs(coordinates[i] - centre[i]);
        if (axis.cyclic)
            distance = std::min(distance, axis.count - distance);
        if (distance > halfWidth[i++])
            return false;
    }
    return true;
}

} // namespace faintline
