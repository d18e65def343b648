#pragma once

#include "model/StateSpace.h"
#include "recursion/semiring.h"

#include <algorithm>
#include <span>
#include <vector>

namespace faintline {

/// The part of a step that differs from cell to cell, ⊗-joined to the scores before the axes' moves.
///
/// P of a renormalised axis is (departure of the source) ⊗ (law of the displacement), and the departures of one axis
/// are independent of the moves of another. With rates, a departure belongs to a rate and a cell, and scores of a rate
/// without a move are first ⊕-joined to those of the rate that replaces it. A full matrix is applied as a whole.
template <class Semiring>
class Departures
{
public:
    using Real = typename Semiring::Real;

    Departures(const StateSpace &space, double transitionScale);

    /// Whether the law is the same in all cells.
    bool areNone() const { return m_ofCells.empty() && m_ofRates.empty() && m_matrices.empty(); }

    /// The scores to which the axes' moves of step number `step` apply: the same memory if the law is the same in all
    /// cells, else valid until the next call.
    std::span<const Real> apply(std::span<const Real> scores, Index step);

private:
    /// An axis with a full matrix; inner: cells of the following axes.
    struct Matrix {
        Index cells;
        Index inner;
        std::vector<Real> weights; ///< from × to
    };

    /// Effect of a renormalised axis with rates on the scores before its step. after: planes that share the rates up to
    /// this axis.
    struct OfRates {
        struct Turn {
            Index cell;
            Index count; ///< cells from `cell` on
            Index fromRate;
            Index toRate;
        };
        Index cells;
        Index inner;
        Index rates;
        Index after;
        Index edge; ///< cells at either end with their own departures; the cells between share one
        struct Phase {
            /// For each rate: the cells of the low end, one between them, those of the high end.
            std::vector<Real> weights;
            std::vector<Turn> turns;
        };
        std::vector<Phase> phases;

        Index places() const { return std::min(cells, 2 * edge + 1); }
        Index cellOf(Index place) const { return place <= edge ? place : cells - places() + place; }
        Index cellsOf(Index place) const { return place == edge ? cells - places() + 1 : 1; }
    };

    Real weight(double ln) const;
    void addRates(const KinematicAxis &axis, Index inner, Index after);
    void apply(const Matrix &matrix, std::span<const Real> from, std::span<Real> to) const;
    void apply(const OfRates &departures, Index step, std::span<Real> scores) const;

    double m_transitionScale;
    Index m_planeSize;
    Index m_planeCount;
    std::vector<Real> m_ofCells; ///< for each cell, without rates
    std::vector<OfRates> m_ofRates;
    std::vector<Matrix> m_matrices;
    std::vector<Real> m_scores;
    std::vector<Real> m_multiplied;
};

extern template class Departures<MaxPlus<float>>;
extern template class Departures<MaxPlus<double>>;
extern template class Departures<SumProduct>;

} // namespace faintline
