#include "detect/Detector.h"

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

void Detector::updateBlock(std::span<const float> y, std::span<float> statistic, Index cells)
{
    const auto size = std::size_t(cells);
    for (std::size_t done = 0; done < y.size(); done += size)
        update(y.subspan(done, size), statistic.subspan(done, size));
}

} // namespace faintline
