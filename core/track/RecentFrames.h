#pragma once

#include "detect/PathDetector.h"
#include "recursion/PathTrace.h"

#include <deque>
#include <vector>

namespace faintline {

/// The newest frames as a detector took them, along which paths into its states are traced back.
///
/// The detector's scores are kept in some of the frames, so that only those behind such a frame are repeated. Memory:
/// memoryShares::pathRecord for each of both, or one frame if nothing is traced.
class RecentFrames
{
public:
    /// One frame as the detector took it.
    struct Seen {
        std::vector<float> y;
        std::vector<double> lnK; ///< for each model
        std::vector<CellBox> forgotten;
    };

    RecentFrames(const std::vector<MarkovModel> &models, const Grid &grid, bool onlyNewest);

    /// Takes the frame after the last one, of which the detector has just made its scores.
    void add(Index frame, Seen seen, const PathDetector &detector);
    void clear();
    /// Number of frames, from this one on, to the next of which add needs the scores.
    Index framesToScores(Index frame) const;

    Seen &newest() { return m_seen.back(); }
    const Seen &at(Index frame) const { return m_seen[std::size_t(frame - m_first)]; }
    Index newestFrame() const { return m_first + std::ssize(m_seen) - 1; }
    Index longest() const { return Index(m_limit); } ///< number of frames kept, at most

    /// For tracePath with one of the models; valid until the next frame.
    RecursionRecord record(std::size_t model) const;

private:
    /// Scores of all states after a frame.
    struct KeptScores {
        Index frame;
        std::vector<std::vector<float>> scores; ///< for each model
    };

    void keepScores(Index frame, const PathDetector &detector);

    std::size_t m_limit;
    std::size_t m_checkpointLimit;
    Index m_first = 0;
    std::deque<Seen> m_seen;
    std::deque<KeptScores> m_checkpoints;
};

} // namespace faintline
