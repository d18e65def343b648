#pragma once

#include "base/Checkpoints.h"
#include "plan/Analysis.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace faintline {

/// Repeats an analysis's chain frame by frame, and returns to earlier frames through checkpoints.
///
/// Starts at the run's checkpoint before the requested frames. Between such starts it stores the chain's state every
/// `interval()` frames, within the byte budget, so that going back costs at most one interval. The scores are bit for
/// bit those of the run; tracks are not traced back. A detector that cannot save its state (fixed-window Viterbi and
/// similar) is restarted. Use one object per thread.
class ChainReplay
{
public:
    ChainReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget);

    const std::shared_ptr<const Analysis> &analysis() const { return m_analysis; }
    const DetectionChain &chain() const { return *m_chain; }
    Index next() const { return m_next; } ///< the frame that `step` takes next
    Index interval() const { return m_checkpoints.interval(); }
    Index beginning() const { return m_beginning; } ///< start of the stretch that its own checkpoints cover

    /// Moves to this frame, or to the nearest checkpoint before it unless the current position is nearer.
    void seek(Index frame);

    /// Takes the next frame; returns its statistic, valid until the next step.
    std::span<const float> step();
    std::span<const float> frame() const { return m_y; } ///< y of the last frame, before inhibition

private:
    /// First frame after the run's checkpoint before `frame`; 0 if there is no earlier one.
    Index beginningOf(Index frame) const;

    std::shared_ptr<const Analysis> m_analysis;
    std::unique_ptr<DetectionChain> m_chain;
    Index m_next = 0;
    Index m_beginning = 0;                 ///< start of the stretch that the checkpoints cover
    Checkpoints<ChainState> m_checkpoints; ///< its own
    std::vector<float> m_y;
    std::vector<float> m_statistic;
};

} // namespace faintline
