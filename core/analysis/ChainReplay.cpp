#include "analysis/ChainReplay.h"

#include "analysis/chain.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr Index shortestInterval = 8;

} // namespace

ChainReplay::ChainReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget)
    : m_analysis(std::move(analysis)), m_chain(makeScoringChain(*m_analysis)), m_y(static_cast<std::size_t>(m_analysis->grid().size())),
      m_statistic(m_y.size())
{
    const std::size_t bytesOfStates = sizeof(float) * static_cast<std::size_t>(stateCount(*m_analysis));
    const auto most = static_cast<Index>(std::max<std::size_t>(1, byteBudget / bytesOfStates));
    m_interval = std::max(shortestInterval, (m_analysis->time().count + most - 1) / most);
}

void ChainReplay::takeCheckpointsOfRun()
{
    for (const ChainCheckpoint &checkpoint : m_analysis->checkpoints)
        m_checkpoints.emplace(checkpoint.frame, checkpoint.state);
}

void ChainReplay::seek(Index frame)
{
    auto nearest = m_checkpoints.upper_bound(frame);
    const bool hasOne = nearest != m_checkpoints.begin();
    if (m_next <= frame && (!hasOne || std::prev(nearest)->first <= m_next))
        return;
    if (!hasOne) {
        m_chain = makeScoringChain(*m_analysis);
        m_next = 0;
        return;
    }
    --nearest;
    m_chain->resume(*nearest->second);
    m_next = nearest->first;
}

std::span<const float> ChainReplay::step()
{
    m_analysis->frames->read(m_next, 1, m_y);
    m_chain->update(m_next, m_y, m_statistic);
    ++m_next;
    if (m_next % m_interval == 0 && !m_checkpoints.contains(m_next))
        if (auto checkpoint = m_chain->snapshot())
            m_checkpoints.emplace(m_next, std::move(checkpoint));
    return m_statistic;
}

} // namespace faintline
