#pragma once

#include "analysis/Analysis.h"
#include "base/Checkpoints.h"
#include "track/DetectionChain.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace faintline {

/// An analysis's chain once more, frame by frame, and back again from checkpoints.
///
/// It begins at the run's checkpoint before the frames requested. From one such beginning to the next it keeps the
/// chain's state every `interval()` frames, as many as go into the byte budget, so that to go back costs at most one
/// interval. Same scores as in the run, bit for bit; tracks are not traced back. A detector that cannot tell its state
/// (fixed-window Viterbi and the like) is begun anew. One object per thread.
class ChainReplay
{
public:
    ChainReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget);

    const std::shared_ptr<const Analysis> &analysis() const { return m_analysis; }
    const DetectionChain &chain() const { return *m_chain; }
    Index next() const { return m_next; } ///< the frame that `step` will take
    Index interval() const { return m_checkpoints.interval(); }
    Index beginning() const { return m_beginning; } ///< of the stretch that its own checkpoints are in

    /// Stands where `step` takes that frame, or one before it: at the nearest checkpoint, unless it is nearer already.
    void seek(Index frame);

    /// Takes the next frame; its statistic, valid until the next step.
    std::span<const float> step();
    std::span<const float> frame() const
    {
        return m_y;
    } ///< y of the last one, before anything was kept from the detector

private:
    /// The frame before which the run's checkpoint before that one stands; 0 if there is no earlier one.
    Index beginningOf(Index frame) const;

    std::shared_ptr<const Analysis> m_analysis;
    std::unique_ptr<DetectionChain> m_chain;
    Index m_next = 0;
    Index m_beginning = 0;                 ///< of the stretch that the checkpoints belong to
    Checkpoints<ChainState> m_checkpoints; ///< its own
    std::vector<float> m_y;
    std::vector<float> m_statistic;
};

} // namespace faintline
