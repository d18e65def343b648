#pragma once

#include "base/Grid.h"

#include <vector>

namespace faintline {

/// A box of cells on a grid: centre ± halfWidth along each axis, wrapped on cyclic axes, clipped on bounded ones.
struct CellBox {
    std::vector<Index> centre;
    std::vector<Index> halfWidth;

    bool contains(const Grid &grid, const std::vector<Index> &coordinates) const;

    /// Calls visit(flat cell index) for each cell of the box.
    template <class Visit>
    void forEachCell(const Grid &grid, Visit visit) const;
};

template <class Visit>
void CellBox::forEachCell(const Grid &grid, Visit visit) const
{
    const auto descend = [&](auto &&self, std::size_t axis, Index flat) -> void {
        if (axis == centre.size()) {
            visit(flat);
            return;
        }
        const Axis &a = grid.axes[axis];
        const bool whole = a.cyclic && 2 * halfWidth[axis] + 1 >= a.count;
        const Index from = whole ? 0 : centre[axis] - halfWidth[axis];
        const Index to = whole ? a.count - 1 : centre[axis] + halfWidth[axis];
        for (Index i = from; i <= to; ++i)
            if (const Index inside = a.wrapped(i); inside >= 0)
                self(self, axis + 1, flat * a.count + inside);
    };
    descend(descend, 0, 0);
}

} // namespace faintline
