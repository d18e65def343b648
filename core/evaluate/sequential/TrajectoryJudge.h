#pragma once

#include "detect/MapTrajectory.h"
#include "evaluate/sequential/SequentialStudy.h"
#include "evaluate/sequential/TrajectorySampler.h"

#include <vector>

namespace faintline {

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
