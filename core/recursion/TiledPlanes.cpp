#include "recursion/TiledPlanes.h"

#include <algorithm>

namespace faintline {

template <class Semiring>
TiledPlanes<Semiring>::TiledPlanes(const PlaneShape &shape, Index reach, Index tileRows)
    : m_shape(shape), m_reach(reach), m_edgeRows(2 * reach + 2 * tileRows >= shape.rows ? shape.rows : reach)
{
    const auto cut = [&](Index from, Index to) {
        for (; from < to; from += tileRows)
            m_tiles.push_back({from, std::min(tileRows, to - from)});
    };
    if (m_edgeRows == shape.rows) {
        cut(0, shape.rows);
    } else {
        cut(0, m_edgeRows);
        cut(m_edgeRows, shape.rows - m_edgeRows);
        cut(shape.rows - m_edgeRows, shape.rows);
    }
    if (m_reach > 0) {
        const Index rows = m_edgeRows == shape.rows ? shape.rows + 2 * m_reach : 2 * (m_edgeRows + 2 * m_reach);
        m_margins.resize(std::size_t(shape.planes * rows * shape.inner));
    }
}

/// Copies rows beyond and near the ends of the first axis: rows -reach … edge+reach and the same at the other end, or
/// all.
template <class Semiring>
void TiledPlanes<Semiring>::fillMargins(std::span<const Real> scores)
{
    if (m_reach == 0)
        return;
    const Index cells = m_shape.rows;
    const Index inner = m_shape.inner;
    Real *to = m_margins.data();
    const auto copyRows = [&](const Real *plane, Index from, Index end) {
        for (Index row = from; row < end;) {
            const bool isInside = row >= 0 && row < cells;
            const Index next = row < 0 ? std::min<Index>(0, end) : row < cells ? std::min(cells, end) : end;
            const Index wrapped = row < 0 ? row + cells : row - cells;
            const Index n = (next - row) * inner;
            if (isInside)
                std::copy_n(plane + row * inner, n, to);
            else if (m_shape.isCyclic)
                std::copy_n(plane + wrapped * inner, n, to);
            else
                std::fill_n(to, n, neutral<Semiring>());
            to += n;
            row = next;
        }
    };
    for (Index number = 0; number < m_shape.planes; ++number) {
        const Real *plane = scores.data() + number * m_shape.size();
        if (m_edgeRows == cells) {
            copyRows(plane, -m_reach, cells + m_reach);
        } else {
            copyRows(plane, -m_reach, m_edgeRows + m_reach);
            copyRows(plane, cells - m_edgeRows - m_reach, cells + m_reach);
        }
    }
}

/// Pointer to a plane's rows from firstRow on, with `reach` more on either side of the tile.
template <class Semiring>
const typename Semiring::Real *TiledPlanes<Semiring>::rowsOf(std::span<const Real> scores, Index plane,
                                                             Index firstRow) const
{
    const Index cells = m_shape.rows;
    const bool isLow = firstRow < m_edgeRows;
    if (m_reach == 0 || (!isLow && firstRow < cells - m_edgeRows))
        return scores.data() + plane * m_shape.size() + firstRow * m_shape.inner;
    const bool isWhole = m_edgeRows == cells;
    const Index rows = m_edgeRows + 2 * m_reach;
    const Index block = isWhole || isLow ? 0 : rows;
    const Index begin = isWhole || isLow ? -m_reach : cells - m_edgeRows - m_reach;
    return m_margins.data() + (plane * (isWhole ? rows : 2 * rows) + block + firstRow - begin) * m_shape.inner;
}

template class TiledPlanes<MaxPlus<float>>;
template class TiledPlanes<MaxPlus<double>>;
template class TiledPlanes<SumProduct>;

} // namespace faintline
