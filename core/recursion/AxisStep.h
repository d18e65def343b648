#pragma once

#include "model/StateSpace.h"
#include "recursion/semiring.h"

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

} // namespace faintline
