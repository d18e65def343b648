#include "analysis/ChainReplay.h"

#include "analysis/chain.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr Index shortestInterval = 8;

} // namespace

ChainReplay::ChainReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget)
    : m_analysis(std::move(analysis)), m_chain(makeScoringChain(*m_analysis)),
      m_y(static_cast<std::size_t>(m_analysis->grid().size())), m_statistic(m_y.size())
{
    const auto most = static_cast<Index>(std::max<std::size_t>(1, byteBudget / bytesOfStates(*m_analysis)));
    const Index stretch = m_analysis->checkpoints.empty() ? m_analysis->time().count : m_analysis->checkpoints.front().frame;
    m_interval = std::max(shortestInterval, (stretch + most - 1) / most);
}

Index ChainReplay::beginningOf(Index frame) const
{
    const ChainCheckpoint *checkpoint = checkpointBefore(*m_analysis, frame);
    return checkpoint ? checkpoint->frame : 0;
}

void ChainReplay::seek(Index frame)
{
    const Index beginning = beginningOf(frame);
    const auto after = m_checkpoints.upper_bound(frame);
    const Index own = after == m_checkpoints.begin() ? 0 : std::prev(after)->first;
    const Index nearest = std::max(beginning, own);
    if (m_next >= nearest && m_next <= frame)
        return;
    if (nearest == 0)
        m_chain = makeScoringChain(*m_analysis);
    else
        m_chain->resume(own == nearest ? *std::prev(after)->second : *checkpointBefore(*m_analysis, frame)->state);
    m_next = nearest;
}

std::span<const float> ChainReplay::step()
{
    m_analysis->frames->read(m_next, 1, m_y);
    m_chain->update(m_next, m_y, m_statistic);
    ++m_next;
    if (const Index beginning = beginningOf(m_next); beginning != m_beginning) {
        m_checkpoints.clear(); // of another stretch
        m_beginning = beginning;
    }
    if (m_next % m_interval == 0 && m_next != m_beginning && !m_checkpoints.contains(m_next))
        if (auto checkpoint = m_chain->snapshot())
            m_checkpoints.emplace(m_next, std::move(checkpoint));
    return m_statistic;
}

} // namespace faintline
