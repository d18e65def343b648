#pragma once

#include "base/Grid.h"
#include "track/HmmTracker.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace faintline {

/// Places on a grid, sorted along its first axis, so that near ones are found without testing all.
class PlaceIndex
{
public:
    PlaceIndex(const Grid &grid, std::vector<std::vector<Index>> places)
        : m_places(std::move(places)), m_axis(grid.axes.front())
    {
        for (std::size_t i = 0; i < m_places.size(); ++i)
            m_order.emplace_back(m_places[i].front(), i);
        std::sort(m_order.begin(), m_order.end());
    }

    std::size_t size() const { return m_places.size(); }
    const std::vector<Index> &operator[](std::size_t number) const { return m_places[number]; }

    /// Calls visit(number) once for each place within `reach` of `place` along the first axis, the short way round on a
    /// cyclic one; the caller tests the other axes.
    template <class Visit>
    void forEachNear(const std::vector<Index> &place, Index reach, Visit visit) const
    {
        const Index at = place.front();
        if (!m_axis.cyclic)
            return forEachBetween(at - reach, at + reach, visit);
        if (2 * reach + 1 >= m_axis.count)
            return forEachBetween(0, m_axis.count - 1, visit);
        for (const Index turn : {-m_axis.count, Index(0), m_axis.count})
            forEachBetween(at - reach + turn, at + reach + turn, visit);
    }

private:
    template <class Visit>
    void forEachBetween(Index low, Index high, Visit visit) const
    {
        const auto first = std::lower_bound(m_order.begin(), m_order.end(), std::pair(low, std::size_t(0)));
        for (auto it = first; it != m_order.end() && it->first <= high; ++it)
            visit(it->second);
    }

    std::vector<std::vector<Index>> m_places;
    Axis m_axis;
    std::vector<std::pair<Index, std::size_t>> m_order; ///< coordinate along the first axis, number
};

// Trackers beside each other: each follows a signal of its own.

/// Cells that belong to another place than number `own`, because they are nearer to it: hidden from the tracker there,
/// they prevent it from moving over to a stronger signal that another one follows. The cells of boxes of `halfWidth`,
/// per axis, around the places at most `farthest` away; a cell may occur more than once. Distance: the largest along
/// any axis, in cells.
std::vector<Index> cellsOfNeighbours(const Grid &grid, const PlaceIndex &places, std::size_t own, Index farthest,
                                     const std::vector<Index> &halfWidth);

/// Removes the younger one of two trackers that follow one signal: those that have been within `linkCells` of each
/// other, per axis, for three frames in succession. Returns the tracks of those removed that had existed separately for
/// longer than beside the other; the rest were second reports of the same signal. `trackers`: the oldest first.
std::vector<Track> endedDuplicates(std::vector<HmmTracker> &trackers, const Grid &grid,
                                   const std::vector<Index> &linkCells);

} // namespace faintline
