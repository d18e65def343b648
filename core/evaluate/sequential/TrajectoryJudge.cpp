#include "evaluate/sequential/TrajectoryJudge.h"

#include "evaluate/sequential/SequentialTrial.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace faintline {

TrajectoryJudge::TrajectoryJudge(const SequentialStudy &study, const TrajectorySampler &sampler)
    : m_study(study), m_sampler(sampler), m_map(study.model)
{
}

TrajectoryJudge::Errors TrajectoryJudge::errorsOf(Index trial, Index stages)
{
    const std::vector<Index> truth = readTrial(trial, stages);
    const Index cells = m_study.model.reduction.stateCells();
    const MapTrajectory map = m_map.estimate(stages, [&](Index stage, std::span<double> out) {
        std::copy_n(m_lambda.begin() + stage * cells, cells, out.begin());
    });
    Errors errors;
    for (Index stage = 0; stage < stages; ++stage) {
        const Index state = map.states[std::size_t(stage)];
        const Index best = m_best[std::size_t(stage * cells + m_study.model.markov.space.cellOf(state))];
        errors.last = distance(position(state, best), truth[std::size_t(stage)]);
        errors.largest = std::max(errors.largest, errors.last);
    }
    return errors;
}

/// The target's true positions.
std::vector<Index> TrajectoryJudge::readTrial(Index number, Index stages)
{
    const Index cells = m_study.model.reduction.stateCells();
    const Index folded = m_study.model.reduction.foldedCells();
    const double lnFolded = std::log(double(folded));
    SequentialTrial trial(m_study, m_sampler, number);
    std::vector<Index> truth;
    m_lambda.assign(std::size_t(stages * cells), 0.0);
    m_best.assign(m_lambda.size(), 0);
    for (Index stage = 0; stage < stages; ++stage) {
        const std::span<const float> y = trial.next();
        truth.push_back(position(trial.state(), trial.folded()));
        for (Index cell = 0; cell < cells; ++cell) {
            Index best = 0;
            for (Index d = 1; d < folded; ++d)
                if (y[std::size_t(d * cells + cell)] > y[std::size_t(best * cells + cell)])
                    best = d;
            const auto at = std::size_t(stage * cells + cell);
            m_best[at] = best;
            m_lambda[at] = m_study.model.markov.likelihood.at(double(y[std::size_t(best * cells + cell)])) - lnFolded;
        }
    }
    return truth;
}

/// Cell of a state. If every axis is folded, the cell on the folded axes: for a line about which nothing is known.
Index TrajectoryJudge::position(Index state, Index folded) const
{
    return isAllFolded() ? folded : m_study.model.markov.space.cellOf(state);
}

Index TrajectoryJudge::distance(Index a, Index b) const
{
    if (isAllFolded())
        return std::abs(a - b);
    Index largest = 0;
    Index inner = 1;
    const std::vector<KinematicAxis> &axes = m_study.model.markov.space.axes();
    for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
        Index along = std::abs(a / inner % axis->cells - b / inner % axis->cells);
        if (axis->cyclic)
            along = std::min(along, axis->cells - along);
        largest = std::max(largest, along);
        inner *= axis->cells;
    }
    return largest;
}

} // namespace faintline
