#include "detect/MapTrajectory.h"

#include "base/logmath.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr Index keptScores = 32 * 1024 * 1024 / 8;
    constexpr std::size_t keptStates = 4096; ///< number of states whose predecessors are stored

} // namespace

MapEstimator::MapEstimator(const SequentialModel &model)
    : m_space(model.markov.space), m_transitionScale(model.markov.transitionScale), m_initial(model.initialLaw()),
      m_recursion(m_space, m_transitionScale), m_lambda(std::size_t(m_space.cellCount()))
{
}

MapEstimator::Scores MapEstimator::start(const Evidence &evidence)
{
    evidence(0, m_lambda);
    Scores scores(m_initial.size());
    for (std::size_t n = 0; n < scores.size(); ++n)
        scores[n] = m_initial[n] > 0.0 ? std::log(m_initial[n]) + m_lambda[n % m_lambda.size()] : minusInfinity;
    return scores;
}

MapEstimator::Scores MapEstimator::next(const Scores &before, Index stage, const Evidence &evidence)
{
    evidence(stage, m_lambda);
    const std::span<const double> predicted = m_recursion.predict(before, stage);
    Scores scores(predicted.begin(), predicted.end());
    for (std::size_t n = 0; n < scores.size(); n += m_lambda.size())
        for (std::size_t cell = 0; cell < m_lambda.size(); ++cell)
            scores[n + cell] += m_lambda[cell];
    return scores;
}

Index MapEstimator::origin(Index state, Index stage, const Scores &before)
{
    if (m_predecessors.size() > keptStates)
        m_predecessors.clear();
    const auto [found, isNew] = m_predecessors.try_emplace({state, stage % m_space.phaseCount()});
    if (isNew)
        found->second = m_space.predecessors(state, stage);
    if (found->second.empty()) // of an impossible trajectory
        return state;
    Index best = -1;
    double bestScore = minusInfinity;
    for (const StateSpace::Predecessor &p : found->second) {
        const double score = before[std::size_t(p.state)] + p.lnProbability * m_transitionScale;
        if (score > bestScore || best < 0) {
            bestScore = score;
            best = p.state;
        }
    }
    return best;
}

MapTrajectory MapEstimator::estimate(Index stages, const Evidence &evidence, const RunContext &context)
{
    const Index states = m_space.stateCount();
    const bool keepsAll = stages * states <= keptScores;
    const Index stride = keepsAll ? stages : Index(std::ceil(std::sqrt(double(stages))));
    std::vector<Scores> milestones; // stages 0, stride, 2·stride, …
    std::vector<Scores> block;      // the stages since the last milestone
    for (Index stage = 0; stage < stages; ++stage) {
        context.checkpoint(0.5 * double(stage) / double(stages), "trajectory");
        Scores scores = stage == 0 ? start(evidence) : next(block.back(), stage, evidence);
        if (stage % stride == 0) {
            milestones.push_back(scores);
            block.clear();
        }
        block.push_back(std::move(scores));
    }

    MapTrajectory map;
    map.states.resize(std::size_t(stages));
    const auto last = std::max_element(block.back().begin(), block.back().end());
    map.lnScore = *last;
    Index state = last - block.back().begin();
    for (Index first = (std::ssize(milestones) - 1) * stride, stage = stages - 1; stage >= 0; first -= stride) {
        context.checkpoint(1.0 - 0.5 * double(stage) / double(stages), "trajectory");
        for (; stage >= first; --stage) {
            map.states[std::size_t(stage)] = state;
            if (stage > first)
                state = origin(state, stage, block[std::size_t(stage - first - 1)]);
        }
        if (first == 0)
            break;
        block.assign(1, std::move(milestones[std::size_t(first / stride - 1)]));
        for (Index again = first - stride + 1; again < first; ++again)
            block.push_back(next(block.back(), again, evidence));
        state = origin(state, first, block.back());
    }
    return map;
}

} // namespace faintline
