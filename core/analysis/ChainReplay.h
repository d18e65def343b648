#pragma once

#include "analysis/analyse.h"
#include "track/DetectionChain.h"

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace faintline {

/// An analysis's chain once more, frame by frame, and back again from checkpoints.
///
/// On its way it keeps the chain's state every `interval()` frames, as many as go into the byte budget: to go back costs at most one
/// interval, of the whole way that was gone before. Those that the run itself kept are few, for they stay as long as the analysis; who
/// needs scores only sets out from them, who follows paths (LayerReplay) from the first frame. Same scores as in the run, bit for bit;
/// tracks are not traced back. A detector that cannot tell its state (fixed-window Viterbi and the like) is begun anew. One object per
/// thread.
class ChainReplay
{
public:
    ChainReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget);

    /// From now on `seek` goes on from the run's own checkpoints as well: for who needs nothing that was before them.
    void takeCheckpointsOfRun();

    const std::shared_ptr<const Analysis> &analysis() const { return m_analysis; }
    const DetectionChain &chain() const { return *m_chain; }
    Index next() const { return m_next; } ///< the frame that `step` will take
    Index interval() const { return m_interval; }

    /// Stands where `step` takes that frame, or one before it: at the nearest checkpoint, unless it is on the way there already.
    void seek(Index frame);

    /// Takes the next frame; its statistic, valid until the next step.
    std::span<const float> step();
    std::span<const float> frame() const { return m_y; } ///< y of the last one, before anything was kept from the detector

private:
    std::shared_ptr<const Analysis> m_analysis;
    std::unique_ptr<DetectionChain> m_chain;
    Index m_interval;
    Index m_next = 0;
    std::map<Index, std::shared_ptr<const DetectionChain::Snapshot>> m_checkpoints; ///< by the frame that comes next
    std::vector<float> m_y;
    std::vector<float> m_statistic;
};

} // namespace faintline
