#pragma once

#include "model/StateSpace.h"
#include "recursion/semiring.h"

#include <span>
#include <vector>

namespace faintline {

template <class Real>
struct Shift {
    /// First axis: a rate or a maximum (numbered after the rates); later axes: a plane or a shifted copy.
    Index from;
    Index cells;
    Real weight; ///< ln P or P
};

/// Moves of one axis. Planes are numbered within the group that shares the rates of the preceding axes.
template <class Real>
struct AxisStep {
    Index cells;
    Index inner; ///< cells of the following axes
    bool cyclic;
    /// For each target plane, lowest source rate first; empty: nothing moves.
    std::vector<std::vector<Shift<Real>>> shifts{};
    std::vector<Shift<Real>> copies{}; ///< for a later axis: shifted planes to prepare, numbered after the planes
};

/// Moves of all axes in the steps of one phase.
template <class Real>
struct PhaseSteps {
    AxisStep<Real> first;
    std::vector<AxisStep<Real>> later{}; ///< the axes that move

    /// Largest displacement along the first axis.
    Index reach() const;
};

template <class Semiring>
PhaseSteps<typename Semiring::Real> stepsOfPhase(const StateSpace &space, Index phase, double transitionScale);

/// Moves a tile's plane along a later axis by `cells`; cells from beyond the ends are neutral or wrapped.
template <class Semiring>
void shiftCells(const AxisStep<typename Semiring::Real> &step, Index cells,
                std::span<const typename Semiring::Real> from, typename Semiring::Real *to);

extern template struct PhaseSteps<float>;
extern template struct PhaseSteps<double>;

/// max(of(cell), other(cell - back)) of two rates or maxima, needed at shifts smallest … largest.
struct SharedMaximum {
    Index number; ///< numbered after the rates: first maxima over two rates, then over four
    Index of;
    Index other;
    Index back;
    Index smallest;
    Index largest;
};

/// Maxima over two and four rates, shared by the targets of one axis.
struct SharedMaxima {
    /// The maxima to compute before each target rate, in this order.
    std::vector<std::vector<SharedMaximum>> before;
    std::vector<Index> largest; ///< largest shift at which each is needed
    Index ring = 0;             ///< number of rates whose maxima are kept at a time; 0: no maxima

    /// Largest number of cells beyond its tile that a maximum needs.
    Index longestSpan() const;
};

/// Replaces runs of sources of equal weight, each two rates and a cell after the previous one, by maxima over two and
/// four of them. They may overlap, because repetition does not change a maximum. `keepsAll`: keeps the maxima until all
/// targets are finished.
template <class Real>
SharedMaxima shareMaxima(AxisStep<Real> &step, bool keepsAll);

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
