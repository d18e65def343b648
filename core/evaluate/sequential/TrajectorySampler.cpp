#include "evaluate/sequential/TrajectorySampler.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace faintline {

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
    const std::vector<Move> &moves = law.moves[std::size_t(step % a.phaseCount())][std::size_t(rate)];
    const auto exists = [&](const Move &m) { return a.cyclic || (cell + m.cells >= 0 && cell + m.cells < a.cells); };
    double left = 0.0;
    for (const Move &m : moves)
        left += exists(m) ? m.probability : 0.0;
    left *= uniform;
    const Move *chosen = nullptr;
    for (const Move &m : moves) {
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
