#pragma once

#include "model/StateSpace.h"

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

/// One step of dynamic programming over a kinematic state space, before the new data are added:
///
///   M(n) = ⊕_m F(m) ⊗ P(n | m)
///
/// Every detector of the program stands on this one recursion; they differ in ⊕ (max of logarithms, or sum of weights),
/// in what they join to M (a reset, or nothing) and in how they decide. The axes are independent, so P is a product and
/// ⊕ is taken one axis at a time, as joins of shifted contiguous planes.
///
/// What differs from cell to cell (a renormalised walk's departures, a full matrix) is ⊗-joined to the scores beforehand: P of an
/// axis is (departure of the source) ⊗ (law of the displacement), and the departures of one axis do not mind the moves of another.
///
/// Unreached states hold ⊕'s neutral element (-∞, or 0). Cost: states × Σ over axes of moves per target rate.
/// Oracle: enumeration of all paths. Scratch memory belongs to this object: one object per thread.
template <class Semiring>
class Recursion
{
public:
    using Real = typename Semiring::Real;

    explicit Recursion(const StateSpace &space, double transitionScale = 1.0);

    /// ⊕ over predecessors of `scores` (stateCount values). The answer stays valid until the next call.
    std::span<Real> predict(std::span<const Real> scores);

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
        Index toPlane;
        int cells;
        Real weight; ///< ln P or P
    };

    /// One axis's moves: planes of `blocks` × (cells · inner) values, shifted by `cells` · inner.
    struct AxisStep {
        Index cells;
        Index inner;
        Index blocks;
        bool cyclic;
        std::vector<Shift> shifts; ///< ordered by target plane
    };

    void apply(const AxisStep &step, std::span<const Real> from, std::span<Real> to) const;
    void join(const AxisStep &step, const Shift &shift, bool isFirst, const Real *from, Real *to) const;

    Index m_planeSize;
    std::vector<AxisStep> m_steps;
    std::vector<Real> m_result;
    std::vector<Real> m_scratch;
    std::vector<Real> m_departures; ///< of every cell; empty where the law is the same everywhere
    std::vector<MatrixStep> m_matrices;
    std::vector<Real> m_prepared;
    std::vector<Real> m_multiplied;
};

extern template class Recursion<MaxPlus<float>>;
extern template class Recursion<MaxPlus<double>>;
extern template class Recursion<SumProduct>;

} // namespace faintline
