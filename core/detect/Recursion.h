#pragma once

#include "model/StateSpace.h"

#include <functional>
#include <span>
#include <vector>

namespace faintline {

/// The (⊕, ⊗) the recursion runs on. Scores are logarithms under max-plus, plain weights under sum-product.
template <class R>
struct MaxPlus {
    using Real = R;
    static constexpr bool logarithmic = true;
};

struct SumProduct {
    using Real = double;
    static constexpr bool logarithmic = false;
};

/// A source plane, moved to where its values are needed.
template <class Real>
struct ShiftedPlane {
    const Real *from;
    Real weight;
};

/// One step of dynamic programming over a kinematic state space, before the new data are added:
///
///   M(n) = ⊕_m F(m) ⊗ P(n | m)
///
/// Every detector of the program stands on this one recursion; they differ in ⊕ (max of logarithms, or sum of weights),
/// in what they join to M (a reset, or nothing) and in how they decide. The axes are independent, so P is a product and
/// ⊕ is taken one axis at a time: a target plane is the join of shifted source planes, all of them in one sweep.
/// The cells are gone through in tiles of the slowest axis; within one, all axes' steps are done while it is in cache.
///
/// What differs from cell to cell (a renormalised walk's departures, a full matrix) is ⊗-joined to the scores beforehand: P of an
/// axis is (departure of the source) ⊗ (law of the displacement), and the departures of one axis do not mind the moves of another.
///
/// Unreached states hold ⊕'s neutral element (-∞, or 0). Cost: states × Σ over axes of moves per target rate; memory is
/// read once and, where the caller takes the tiles as they come, written once. Oracle: enumeration of all paths.
/// Scratch memory belongs to this object: one object per thread.
template <class Semiring>
class Recursion
{
public:
    using Real = typename Semiring::Real;

    explicit Recursion(const StateSpace &space, double transitionScale = 1.0);

    /// ⊕ over predecessors of `scores` (stateCount values). The answer stays valid until the next call.
    std::span<Real> predict(std::span<const Real> scores);

    /// Takes M of the states of one plane in cells firstCell, firstCell + 1, …
    using Tile = std::function<void(Index plane, Index firstCell, std::span<const Real> predicted)>;

    /// The same, handed over tile by tile: each state once, planes ascending within a tile, tiles ascending. `scores` must stay
    /// as they are until the end.
    void predict(std::span<const Real> scores, const Tile &take);

private:
    /// An axis with a full matrix; inner: cells of the axes after it.
    struct MatrixStep {
        Index cells;
        Index inner;
        std::vector<Real> weights; ///< from × to
    };

    void preparePlaces(const StateSpace &space, double transitionScale);
    std::span<const Real> prepare(std::span<const Real> scores);
    void apply(const MatrixStep &step, std::span<const Real> from, std::span<Real> to) const;

    struct Shift {
        Index fromPlane;
        Index cells;
        Real weight; ///< ln P or P
    };

    /// How one axis moves. Planes are numbered within the group of those that share the rates of the axes before.
    struct AxisStep {
        Index cells;
        Index inner; ///< cells of the axes after
        bool cyclic;
        std::vector<std::vector<Shift>> shifts; ///< of each target plane, lowest source rate first
    };

    void firstAxis(const Real *scores, Index targetRate, Index firstRow, Index rows, Real *to);
    void laterAxis(const AxisStep &step, const Real *from, Index size, Real *to);
    void laterEdge(const AxisStep &step, const std::vector<Shift> &shifts, Index row, const Real *from, Index size, Real *to);

    Index m_planeSize;
    Index m_planeCount;
    Index m_groups;     ///< rates of the first axis
    Index m_groupSize;  ///< planes that share one of them
    Index m_tileRows;   ///< cells of the first axis that are dealt with at a time
    AxisStep m_first;   ///< no shifts: it does not move
    std::vector<AxisStep> m_later;
    std::vector<Real> m_tile;
    std::vector<Real> m_otherTile;
    std::vector<ShiftedPlane<Real>> m_sources;
    std::vector<Real> m_result; ///< empty until it is asked for
    std::vector<Real> m_departures; ///< of every cell; empty where the law is the same everywhere
    std::vector<MatrixStep> m_matrices;
    std::vector<Real> m_prepared;
    std::vector<Real> m_multiplied;
};

extern template class Recursion<MaxPlus<float>>;
extern template class Recursion<MaxPlus<double>>;
extern template class Recursion<SumProduct>;

} // namespace faintline
