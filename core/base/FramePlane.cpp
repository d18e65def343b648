#include "base/FramePlane.h"

namespace faintline {

CellsBehind::CellsBehind(const Grid &grid, const FramePlane &plane)
    : m_rows(grid.axes[plane.along].count), m_columns(grid.axes[plane.across].count),
      m_rowStride(grid.stride(plane.along)), m_columnStride(grid.stride(plane.across))
{
    for (std::size_t axis = 0; axis < grid.axes.size(); ++axis) {
        if (plane.isShown(axis))
            continue;
        const std::optional<Index> cut = plane.cutOf(axis);
        const Index begin = cut.value_or(0);
        const Index end = cut ? *cut + 1 : grid.axes[axis].count;
        std::vector<Index> longer;
        for (const Index before : m_hidden)
            for (Index i = begin; i < end; ++i)
                longer.push_back(before + i * grid.stride(axis));
        m_hidden = std::move(longer);
    }
}

} // namespace faintline
