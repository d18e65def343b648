#pragma once

#include "base/Random.h"
#include "model/SequentialModel.h"

#include <vector>

namespace faintline {

/// Draws trajectories from a model's own law: the start from P(x1), then move after move.
///
/// A target does not leave a bounded axis or the set of rates: what would leave is shared among the moves that stay, as
/// the model's stochastic law says (KinematicAxis). Oracle: StateSpace::predecessors. One uniform number for the start,
/// one per axis for a move. Thread-safe.
class TrajectorySampler
{
public:
    explicit TrajectorySampler(const SequentialModel &model);

    Index first(Random &random) const;
    /// Step number `step`.
    Index next(Index state, Random &random, Index step = 0) const;

private:
    struct Move {
        int toRate;
        Index cells;
        double probability;
    };
    struct AxisLaw {
        std::vector<std::vector<std::vector<Move>>> moves; ///< in every phase, of every source rate
        std::vector<double> matrix;                        ///< in place of moves, where the axis has one
    };
    void move(std::size_t axis, Index step, int &rate, Index &cell, double uniform) const;

    StateSpace m_space;
    std::vector<double> m_initial; ///< cumulated; empty: uniform
    std::vector<AxisLaw> m_laws;
};

} // namespace faintline
