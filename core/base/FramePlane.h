#pragma once

#include "base/Grid.h"

#include <optional>
#include <vector>

namespace faintline {

/// Two axes of a frame that are shown; each of the others is hidden: reduced to its maximum, or cut at one cell.
///
/// For a spectrum, whose frames have one axis, there is no plane. On two axes the plane is the frame itself.
struct FramePlane {
    std::size_t along = 0;  ///< axis of the rows, shown in place of time
    std::size_t across = 1; ///< axis of the columns
    /// One per axis: the cell at which a hidden axis is cut; none, or no element: the maximum over the axis.
    std::vector<std::optional<Index>> cuts{};

    bool isShown(std::size_t axis) const { return axis == along || axis == across; }
    std::optional<Index> cutOf(std::size_t axis) const
    {
        return isShown(axis) || axis >= cuts.size() ? std::nullopt : cuts[axis];
    }

    bool operator==(const FramePlane &) const = default;
};

/// The cells behind each place of a plane.
///
/// The flat index of a cell is the sum of one offset for its place and one for the hidden axes, so the latter are
/// listed once: { Σ over hidden axes of stride·index }, in ascending order.
class CellsBehind
{
public:
    /// Precondition: the grid has both shown axes, and they differ.
    CellsBehind(const Grid &grid, const FramePlane &plane);

    Index rows() const { return m_rows; }
    Index columns() const { return m_columns; }
    const std::vector<Index> &hidden() const { return m_hidden; }

    /// The first cell of a place, to which `hidden` are added.
    Index first(Index row, Index column) const { return row * m_rowStride + column * m_columnStride; }

    /// The cell with the largest value behind a place; the first of equal ones. `values`: one per cell of the grid.
    template <class Values>
    Index largest(const Values &values, Index row, Index column) const
    {
        Index best = first(row, column) + m_hidden.front();
        for (const Index behind : m_hidden)
            if (const Index cell = first(row, column) + behind; values[std::size_t(cell)] > values[std::size_t(best)])
                best = cell;
        return best;
    }

private:
    Index m_rows;
    Index m_columns;
    Index m_rowStride;
    Index m_columnStride;
    std::vector<Index> m_hidden{0};
};

} // namespace faintline
