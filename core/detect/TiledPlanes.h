#pragma once

#include "detect/semiring.h"

#include <span>
#include <vector>

namespace faintline {

/// How the planes of all states lie, by their slowest axis.
struct PlaneShape {
    Index planes;
    Index rows;  ///< cells of the slowest axis …
    Index inner; ///< … and of all after it
    bool isCyclic;

    Index size() const { return rows * inner; }
};

/// Cells of the slowest axis that are dealt with at a time.
struct TileRows {
    Index first;
    Index count;
};

/// Planes cut into tiles of the slowest axis, so that a tile's rows can be read with `reach` more on either side: those
/// of tiles at the axis's ends from a copy with margins, ⊕'s neutral element or wrapped round.
template <class Semiring>
class TiledPlanes
{
public:
    using Real = typename Semiring::Real;

    TiledPlanes() = default;
    TiledPlanes(const PlaneShape &shape, Index reach, Index tileRows);

    const std::vector<TileRows> &tiles() const { return m_tiles; }

    /// To be called when the scores have changed.
    void fillMargins(std::span<const Real> scores);

    /// Where a plane's rows from firstRow, a tile's first, on lie.
    const Real *rowsOf(std::span<const Real> scores, Index plane, Index firstRow) const;

private:
    PlaneShape m_shape{};
    Index m_reach = 0;
    std::vector<TileRows> m_tiles;
    Index m_edgeRows = 0;        ///< tiles that begin nearer to an end of the axis, or end there, use the margins
    std::vector<Real> m_margins; ///< of each plane: the rows round either end, or all of them
};

extern template class TiledPlanes<MaxPlus<float>>;
extern template class TiledPlanes<MaxPlus<double>>;
extern template class TiledPlanes<SumProduct>;

} // namespace faintline
