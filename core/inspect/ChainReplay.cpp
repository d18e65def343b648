#include "inspect/ChainReplay.h"

#include "plan/chain.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr Index shortestInterval = 8;

    /// Frames between a replay's own checkpoints if the budget held scores only.
    Index intervalOf(const Analysis &analysis, std::size_t byteBudget)
    {
        const auto most = Index(std::max<std::size_t>(1, byteBudget / bytesOfStates(analysis)));
        const Index stretch = analysis.checkpoints.isEmpty() ? analysis.time().count : analysis.checkpoints.interval();
        return std::max(shortestInterval, (stretch + most - 1) / most);
    }

} // namespace

ChainReplay::ChainReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget)
    : m_analysis(std::move(analysis)), m_chain(makeScoringChain(*m_analysis)),
      m_checkpoints(intervalOf(*m_analysis, byteBudget), byteBudget), m_y(std::size_t(m_analysis->grid().size())),
      m_statistic(m_y.size())
{
}

Index ChainReplay::beginningOf(Index frame) const
{
    return m_analysis->checkpoints.latest(frame);
}

void ChainReplay::seek(Index frame)
{
    const Index beginning = beginningOf(frame);
    const Index own = m_checkpoints.latest(frame);
    const Index nearest = std::max(beginning, own);
    if (m_next >= nearest && m_next <= frame)
        return;
    if (nearest == 0)
        m_chain = makeScoringChain(*m_analysis);
    else
        m_chain->setState(own == nearest ? *m_checkpoints.at(own) : *m_analysis->checkpoints.at(beginning));
    m_next = nearest;
}

std::span<const float> ChainReplay::step()
{
    m_analysis->frames->read(m_next, 1, m_y);
    m_chain->update(m_next, m_y, m_statistic);
    ++m_next;
    if (const Index beginning = beginningOf(m_next); beginning != m_beginning) {
        m_checkpoints.clear(); // belong to another stretch
        m_beginning = beginning;
    }
    if (m_checkpoints.lacks(m_next) && m_next != m_beginning)
        if (auto state = m_chain->state())
            m_checkpoints.keep(m_next, state, state->bytes());
    return m_statistic;
}

} // namespace faintline
