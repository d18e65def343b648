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

void Detector::updateBlock(std::span<const float> y, std::span<float> statistic, Index cells)
{
    const auto size = std::size_t(cells);
    for (std::size_t done = 0; done < y.size(); done += size)
        update(y.subspan(done, size), statistic.subspan(done, size));
}

} // namespace faintline
