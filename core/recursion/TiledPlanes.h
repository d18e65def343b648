#pragma once

#include "recursion/semiring.h"

#include <span>
#include <vector>

namespace faintline {

/// Memory layout of the planes of all states, by their slowest axis.
struct PlaneShape {
    Index planes;
    Index rows;  ///< cells of the slowest axis …
    Index inner; ///< … and of all following axes
    bool isCyclic;

    Index size() const { return rows * inner; }
};

/// Cells of the slowest axis that are processed at a time.
struct TileRows {
    Index first;
    Index count;
};

/// Planes divided into tiles of the slowest axis. A tile's rows can be read with `reach` more on either side; tiles at
/// the axis's ends use a copy whose margins hold the neutral element of ⊕ or wrapped values.
template <class Semiring>
class TiledPlanes
{
public:
    using Real = typename Semiring::Real;

    TiledPlanes() = default;
    TiledPlanes(const PlaneShape &shape, Index reach, Index tileRows);

    const std::vector<TileRows> &tiles() const { return m_tiles; }

    /// Call when the scores have changed.
    void fillMargins(std::span<const Real> scores);

    /// Pointer to a plane's rows from firstRow, the first row of a tile, on.
    const Real *rowsOf(std::span<const Real> scores, Index plane, Index firstRow) const;

private:
    PlaneShape m_shape{};
    Index m_reach = 0;
    std::vector<TileRows> m_tiles;
    Index m_edgeRows = 0;        ///< tiles that begin within this distance of an end, or end there, use margins
    std::vector<Real> m_margins; ///< for each plane: the rows around either end, or all of them
};

extern template class TiledPlanes<MaxPlus<float>>;
extern template class TiledPlanes<MaxPlus<double>>;
extern template class TiledPlanes<SumProduct>;

} // namespace faintline
