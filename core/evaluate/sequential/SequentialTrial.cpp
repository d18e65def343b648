#include "evaluate/sequential/SequentialTrial.h"

#include "detect/cellAveraging.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace faintline {

SequentialTrial::SequentialTrial(const SequentialStudy &study, const TrajectorySampler &sampler, Index trial)
    : m_study(&study), m_sampler(&sampler), m_noise(study.seed, 2 * std::uint64_t(trial)),
      m_target(study.seed, 2 * std::uint64_t(trial) + 1), m_frameCells(study.model.reduction.frameCells())
{
    // Whole blocks of four random words at a time, about 256 cells, or one frame.
    m_bufferFrames =
        m_frameCells % 4 == 0 ? std::max<Index>(1, 256 / m_frameCells) : 4 * std::max<Index>(1, 64 / m_frameCells);
    m_used = m_bufferFrames;
    m_buffer.resize(std::size_t(m_bufferFrames * m_frameCells));
}

std::span<const float> SequentialTrial::next()
{
    if (m_used == m_bufferFrames) {
        m_noise.exponentials(m_buffer);
        m_used = 0;
    }
    const std::span<float> y(m_buffer.data() + m_used * m_frameCells, std::size_t(m_frameCells));
    ++m_used;
    if (m_study->actualSnr) {
        m_state = m_state < 0 ? m_sampler->first(m_target) : m_sampler->next(m_state, m_target, m_stage);
        ++m_stage;
        const StateSpace &space = m_study->model.markov.space;
        if (const Index folded = m_study->model.reduction.foldedCells(); folded > 1)
            m_folded = Index(m_target.uniform() * double(folded));
        float &cell = y[std::size_t(m_folded * space.cellCount() + space.cellOf(m_state))];
        cell *= float(1.0 + *m_study->actualSnr);
    }
    if (m_study->averagedCells > 0) {
        averageCells(y, m_study->model.markov.space.axes().back().cells, m_study->averagedCells);
        correctAveraged(y, m_study->averagedCells, m_study->model.markov.likelihood.snr());
    }
    return y;
}

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

TrajectorySampler::TrajectorySampler(const SequentialModel &model)
    : m_space(model.markov.space), m_initial(model.initial)
{
    std::partial_sum(m_initial.begin(), m_initial.end(), m_initial.begin());
    for (const KinematicAxis &axis : m_space.axes()) {
        AxisLaw law{{}, axis.transition};
        for (Index phase = 0; phase < axis.phaseCount(); ++phase) {
            auto &ofRates = law.moves.emplace_back(std::size_t(axis.rateCount));
            for (const KinematicAxis::Move &move : axis.moves(phase))
                ofRates[std::size_t(move.fromRate)].push_back({move.toRate, move.cells, std::exp(move.lnProbability)});
        }
        m_laws.push_back(std::move(law));
    }
}

Index TrajectorySampler::first(Random &random) const
{
    const double uniform = random.uniform();
    if (m_initial.empty())
        return Index(uniform * double(m_space.stateCount()));
    const auto found = std::upper_bound(m_initial.begin(), m_initial.end(), uniform * m_initial.back());
    return std::min<Index>(found - m_initial.begin(), m_space.stateCount() - 1);
}

void TrajectorySampler::move(std::size_t axis, Index step, int &rate, Index &cell, double uniform) const
{
    const KinematicAxis &a = m_space.axes()[axis];
    const AxisLaw &law = m_laws[axis];
    if (!law.matrix.empty()) {
        const auto row = law.matrix.begin() + cell * a.cells;
        double left = uniform * std::accumulate(row, row + a.cells, 0.0);
        for (Index to = 0; to < a.cells; ++to) {
            left -= row[to];
            if (row[to] > 0.0)
                cell = to;
            if (left < 0.0)
                return;
        }
        return;
    }
    rate = a.rateGoingOn(cell, rate, step);
    const std::vector<RateMove> &moves = law.moves[std::size_t(step % a.phaseCount())][std::size_t(rate)];
    const auto exists = [&](const RateMove &m) {
        return a.cyclic || (cell + m.cells >= 0 && cell + m.cells < a.cells);
    };
    double left = 0.0;
    for (const RateMove &m : moves)
        left += exists(m) ? m.probability : 0.0;
    left *= uniform;
    const RateMove *chosen = nullptr;
    for (const RateMove &m : moves) {
        if (!exists(m))
            continue;
        chosen = &m;
        left -= m.probability;
        if (left < 0.0)
            break;
    }
    if (!chosen) // at the end of the axis with a rate that leaves it
        return;
    rate = chosen->toRate;
    cell = ((cell + chosen->cells) % a.cells + a.cells) % a.cells;
}

Index TrajectorySampler::next(Index state, Random &random, Index step) const
{
    StateSpace::Coordinates c = m_space.coordinates(state);
    for (std::size_t axis = 0; axis < m_laws.size(); ++axis)
        move(axis, step, c.rates[axis], c.cells[axis], random.uniform());
    return m_space.state(c);
}

} // namespace faintline
