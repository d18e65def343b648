#pragma once

#include "base/Random.h"
#include "detect/MapTrajectory.h"
#include "detect/Sprt.h"
#include "model/SequentialModel.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace faintline {

/// Simulation of a sequential test under conditions that may differ from its design.
///
/// Cells are exponential: mean 1 without the target, 1 + actualSnr with it (Grossi and Lops 2006, eq. 10); the target's
/// start and moves follow the model's law. λ is given by the model's likelihood, exponential with the design SNR.
struct SequentialStudy {
    SequentialModel model;
    SprtSettings sprt;
    std::optional<double> actualSnr; ///< power ratio; nothing: noise only
    Index trials = 1000;
    std::uint64_t seed = 1;
    Index averagedCells = 0;          ///< N of averageCells along the model's last axis; 0: known noise power
    bool estimatesTrajectory = false; ///< if H1 is accepted
    Index lastWithinCells = 2;        ///< P_c,last: largest error at the stopping stage that counts as correct
    Index trackWithinCells = 5;       ///< P_c,track: the same over all stages
};

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
    struct RateMove {
        int toRate;
        Index cells;
        double probability;
    };
    struct AxisLaw {
        std::vector<std::vector<std::vector<RateMove>>> moves; ///< for each phase and source rate
        std::vector<double> matrix;                            ///< replaces moves if the axis has one
    };
    void move(std::size_t axis, Index step, int &rate, Index &cell, double uniform) const;

    StateSpace m_space;
    std::vector<double> m_initial; ///< cumulative; empty: uniform
    std::vector<AxisLaw> m_laws;
};

/// One trial of a study: its frames and its truth, as in `simulate`.
class SequentialTrial
{
public:
    SequentialTrial(const SequentialStudy &study, const TrajectorySampler &sampler, Index trial);

    /// The next stage's frame, one block of the model's cells per folded cell. Valid until the next call.
    std::span<const float> next();

    Index state() const { return m_state; }   ///< of the target in the last frame
    Index folded() const { return m_folded; } ///< its cell on the folded axes

private:
    const SequentialStudy *m_study;
    const TrajectorySampler *m_sampler;
    Random m_noise;
    Random m_target;
    Index m_frameCells;
    Index m_bufferFrames;
    Index m_used;
    std::vector<float> m_buffer;
    Index m_stage = 0; ///< of the next frame
    Index m_state = -1;
    Index m_folded = 0;
};

/// Estimates the trajectory of an accepted trial and compares it with the truth. Use one object per thread.
class TrajectoryJudge
{
public:
    TrajectoryJudge(const SequentialStudy &study, const TrajectorySampler &sampler);

    /// Largest distance along any axis, in cells.
    struct Errors {
        Index last = 0; ///< at the stopping stage
        Index largest = 0;
    };
    Errors errorsOf(Index trial, Index stages);

private:
    std::vector<Index> readTrial(Index number, Index stages);
    bool isAllFolded() const { return m_study.model.reduction.stateCells() == 1; }
    Index position(Index state, Index folded) const;
    Index distance(Index a, Index b) const;

    const SequentialStudy &m_study;
    const TrajectorySampler &m_sampler;
    MapEstimator m_map;
    std::vector<double> m_lambda; ///< stages × cells: λ of the best among the cells folded into one
    std::vector<Index> m_best;    ///< index of that cell
};

} // namespace faintline
