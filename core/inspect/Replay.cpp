#include "inspect/Replay.h"

#include "plan/chain.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr Index shortestInterval = 8;
    constexpr Index readAheadValues = Index(1) << 18;

    /// Frames between a replay's own checkpoints if the budget held scores only.
    Index intervalOf(const Analysis &analysis, std::size_t byteBudget)
    {
        const auto most = Index(std::max<std::size_t>(1, byteBudget / bytesOfStates(analysis)));
        const Index stretch = analysis.checkpoints.isEmpty() ? analysis.time().count : analysis.checkpoints.interval();
        return std::max(shortestInterval, (stretch + most - 1) / most);
    }

    std::unique_ptr<DetectionChain> chainOf(const Analysis &analysis, Replay::Of what)
    {
        return makeChain(analysis, makePathDetector(analysis, true), what == Replay::Of::Paths);
    }

} // namespace

Replay::Replay(const Analysis &analysis, std::size_t byteBudget, Of what)
    : m_analysis(&analysis), m_budget(byteBudget), m_what(what), m_chain(chainOf(analysis, what)),
      m_checkpoints(intervalOf(analysis, byteBudget), byteBudget), m_statistic(std::size_t(analysis.grid().size()))
{
}

void Replay::seek(Index frame)
{
    const Index beginning = m_analysis->checkpoints.latest(frame);
    const Index own = m_checkpoints.latest(frame);
    const Index nearest = std::max(beginning, own);
    if (m_next >= nearest && m_next <= frame)
        return;
    if (nearest == 0)
        m_chain = chainOf(*m_analysis, m_what);
    else
        m_chain->setState(own == nearest ? *m_checkpoints.at(own) : *m_analysis->checkpoints.at(beginning));
    m_next = nearest;
}

void Replay::readAhead(Index end)
{
    const Index cells = std::ssize(m_statistic);
    if (m_next >= m_blockBegin && m_next < m_blockBegin + std::ssize(m_block) / cells)
        return;
    const Index count = std::clamp<Index>(readAheadValues / cells, 1, end - m_next);
    m_block.resize(std::size_t(count * cells));
    m_analysis->frames->read(m_next, count, m_block);
    m_blockBegin = m_next;
}

std::span<const float> Replay::step()
{
    readAhead(m_next + 1);
    const auto place = std::size_t(m_next - m_blockBegin) * m_statistic.size();
    m_chain->update(m_next, std::span(m_block).subspan(place, m_statistic.size()), m_statistic);
    ++m_next;
    if (const Index beginning = m_analysis->checkpoints.latest(m_next); beginning != m_beginning) {
        m_checkpoints.clear(); // belong to another stretch
        m_beginning = beginning;
    }
    if (m_budget > 0 && m_checkpoints.lacks(m_next) && m_next != m_beginning)
        if (auto state = m_chain->state())
            m_checkpoints.keep(m_next, state, state->bytes());
    return m_statistic;
}

} // namespace faintline
