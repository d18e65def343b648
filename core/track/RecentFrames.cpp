#include "track/RecentFrames.h"

#include "base/memoryShares.h"

#include <algorithm>
#include <limits>

namespace faintline {

namespace {

    constexpr Index checkpointFrames = 32; ///< frames between checkpoints

    std::size_t frameLimit(const Grid &grid)
    {
        const std::size_t most = memoryShares::pathRecord / (sizeof(float) * std::size_t(grid.size()));
        return std::clamp<std::size_t>(most, 16, 4096);
    }

    std::size_t checkpointLimit(const std::vector<MarkovModel> &models)
    {
        std::size_t states = 0;
        for (const MarkovModel &model : models)
            states += std::size_t(model.space.stateCount());
        return memoryShares::pathRecord / (sizeof(float) * states);
    }

} // namespace

RecentFrames::RecentFrames(const std::vector<MarkovModel> &models, const Grid &grid, bool onlyNewest)
    : m_limit(onlyNewest ? 1 : frameLimit(grid)), m_checkpointLimit(onlyNewest ? 0 : checkpointLimit(models))
{
}

void RecentFrames::add(Index frame, Seen seen, const PathDetector &detector)
{
    if (m_seen.size() == m_limit) {
        m_seen.pop_front();
        ++m_first;
    }
    if (m_seen.empty())
        m_first = frame;
    m_seen.push_back(std::move(seen));
    if (m_checkpointLimit > 0 && frame % checkpointFrames == 0)
        keepScores(frame, detector);
}

void RecentFrames::keepScores(Index frame, const PathDetector &detector)
{
    // Checkpoints before the recorded frames are useless. The oldest one's memory is reused, because new pages cost as
    // much as writing to them.
    KeptScores checkpoint;
    if (!m_checkpoints.empty()
        && (m_checkpoints.size() == m_checkpointLimit || m_checkpoints.front().frame < m_first)) {
        checkpoint = std::move(m_checkpoints.front());
        m_checkpoints.pop_front();
    }
    checkpoint.frame = frame;
    checkpoint.scores.resize(detector.modelCount());
    for (std::size_t i = 0; i < checkpoint.scores.size(); ++i) {
        const std::span<const float> scores = detector.scores(i);
        checkpoint.scores[i].assign(scores.begin(), scores.end());
    }
    m_checkpoints.push_back(std::move(checkpoint));
}

Index RecentFrames::framesToScores(Index frame) const
{
    return m_checkpointLimit == 0 ? std::numeric_limits<Index>::max()
                                  : 1 + (checkpointFrames - frame % checkpointFrames) % checkpointFrames;
}

void RecentFrames::clear()
{
    m_seen.clear();
    m_checkpoints.clear();
}

RecursionRecord RecentFrames::record(std::size_t model) const
{
    RecursionRecord result;
    result.firstFrame = m_first;
    result.frame = [this](Index frame) { return std::span<const float>(at(frame).y); };
    result.lnK = [this, model](Index frame) { return at(frame).lnK[model]; };
    result.forgotten = [this](Index frame) { return std::span<const CellBox>(at(frame).forgotten); };
    result.checkpoint = [this, model](Index before) {
        const auto latest = std::find_if(m_checkpoints.rbegin(), m_checkpoints.rend(),
                                         [before](const KeptScores &checkpoint) { return checkpoint.frame < before; });
        return latest == m_checkpoints.rend() ? RecursionRecord::Checkpoint{}
                                              : RecursionRecord::Checkpoint{latest->frame, latest->scores[model]};
    };
    return result;
}

} // namespace faintline
