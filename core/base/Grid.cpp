#include "base/Grid.h"

namespace faintline {

Index Grid::size() const
{
    if (axes.empty())
        return 0;
    Index product = 1;
    for (const Axis &axis : axes)
        product *= axis.count;
    return product;
}

Index Grid::stride(std::size_t axis) const
{
    Index product = 1;
    for (std::size_t later = axis + 1; later < axes.size(); ++later)
        product *= axes[later].count;
    return product;
}

std::vector<Index> Grid::coordinates(Index cell) const
{
    std::vector<Index> result(axes.size());
    for (std::size_t axis = axes.size(); axis-- > 0;) {
        result[axis] = cell % axes[axis].count;
        cell /= axes[axis].count;
    }
    return result;
}

Index Grid::cell(const std::vector<Index> &coordinates) const
{
    Index flat = 0;
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
        const Index inside = axes[axis].wrapped(coordinates[axis]);
        if (inside < 0)
            return -1;
        flat = flat * axes[axis].count + inside;
    }
    return flat;
}

} // namespace faintline
