#pragma once

#include "base/Random.h"
#include "model/SequentialModel.h"

#include <vector>

namespace faintline {

/// Draws trajectories from a model's own law: the start from P(x1), then one move after the other.
///
/// A target does not leave a bounded axis or the set of rates: the moves that stay share the probability of leaving, as
/// in the model's stochastic law (KinematicAxis). Oracle: StateSpace::predecessors. Uses one uniform number for the
/// start and one per axis for a move. Thread-safe.
class TrajectorySampler
{
public:
    explicit TrajectorySampler(const SequentialModel &model);

    Index first(Random &random) const;
    /// Draws step number `step`.
    Index next(Index state, Random &random, Index step = 0) const;

private:
    struct Move {
        int toRate;
        Index cells;
        double probability;
    };
    struct AxisLaw {
        std::vector<std::vector<std::vector<Move>>> moves; ///< for each phase and source rate
        std::vector<double> matrix;                        ///< replaces moves if the axis has one
    };
    void move(std::size_t axis, Index step, int &rate, Index &cell, double uniform) const;

    StateSpace m_space;
    std::vector<double> m_initial; ///< cumulative; empty: uniform
    std::vector<AxisLaw> m_laws;
};

} // namespace faintline
