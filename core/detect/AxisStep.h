#pragma once

#include "detect/semiring.h"
#include "model/StateSpace.h"

#include <vector>

namespace faintline {

template <class Real>
struct Shift {
    /// First axis: a rate, or a maximum (numbered on from the rates); later axes: a plane, or a shifted copy.
    Index from;
    Index cells;
    Real weight; ///< ln P or P
};

/// How one axis moves. Planes are numbered within the group of those that share the rates of the axes before.
template <class Real>
struct AxisStep {
    Index cells;
    Index inner; ///< cells of the axes after
    bool cyclic;
    /// Of each target plane, lowest source rate first; empty: nothing moves.
    std::vector<std::vector<Shift<Real>>> shifts{};
    std::vector<Shift<Real>> copies{}; ///< of a later axis: planes that are wanted shifted, numbered on from the planes
};

/// How all axes move in the steps of one phase.
template <class Real>
struct PhaseSteps {
    AxisStep<Real> first;
    std::vector<AxisStep<Real>> later{}; ///< of those axes that move

    /// Largest displacement along the first axis.
    Index reach() const;
};

template <class Semiring>
PhaseSteps<typename Semiring::Real> stepsOfPhase(const StateSpace &space, Index phase, double transitionScale);

/// Moves a tile's plane along a later axis by so many cells; what would come from beyond the axis's ends is neutral, or
/// wrapped round.
template <class Semiring>
void shiftCells(const AxisStep<typename Semiring::Real> &step, Index cells,
                std::span<const typename Semiring::Real> from, typename Semiring::Real *to);

extern template struct PhaseSteps<float>;
extern template struct PhaseSteps<double>;

} // namespace faintline
