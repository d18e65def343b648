#pragma once

#include "base/RunContext.h"
#include "model/SequentialModel.h"
#include "recursion/Recursion.h"

#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace faintline {

/// A trajectory and its probability.
struct MapTrajectory {
    std::vector<Index> states; ///< of the model, one per stage
    double lnScore = 0.0;      ///< ln [ P_1(x_1) Π P(x_k|x_{k-1}) Π p1/p0 ]
};

/// The most probable trajectory of a present target.
///
///   F_1(n) = ln P_1(n) + λ_1(n),   F_k(n) = λ_k(n) + max_m [ F_{k-1}(m) + ln P(n|m) ]
///   x_K = argmax F_K,              x_{k-1} = argmax_m of step k
///
/// There are no back-pointers: the argmax is repeated along the one trajectory. If the scores of all stages exceed 32
/// MiB, only those of every √K-th stage are kept, and the stages between are computed a second time. Ties: the lowest
/// state, rates before cells. Source: Grossi and Lops 2006, Algorithm 3.2. Oracle: enumeration of all trajectories. Use
/// one object per thread.
class MapEstimator
{
public:
    explicit MapEstimator(const SequentialModel &model);

    /// Writes λ of the model's cells at a stage 0, 1, …; called in ascending order, for some stages a second time.
    using Evidence = std::function<void(Index stage, std::span<double> lambda)>;

    /// Precondition: stages ≥ 1.
    MapTrajectory estimate(Index stages, const Evidence &evidence, const RunContext &context = {});

private:
    using Scores = std::vector<double>;

    Scores start(const Evidence &evidence);
    Scores next(const Scores &before, Index stage, const Evidence &evidence);
    Index origin(Index state, Index stage, const Scores &before);

    StateSpace m_space;
    double m_transitionScale;
    std::vector<double> m_initial;
    Recursion<MaxPlus<double>> m_recursion;
    std::vector<double> m_lambda;
    /// For the states that trajectories passed through, by phase.
    std::map<std::pair<Index, Index>, std::vector<StateSpace::Predecessor>> m_predecessors;
};

} // namespace faintline
