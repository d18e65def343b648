#pragma once

#include "base/Field.h"
#include "detect/Detector.h"
#include "detect/Smd.h"

#include <vector>

namespace faintline {

/// Window length of fixed-window detection.
struct BlockViterbiSettings {
    double durationWindows = 50.0; ///< in windows of the spectrogram (frames on ready-made frames)

    static const std::vector<Field<BlockViterbiSettings>> &fields();
    bool operator==(const BlockViterbiSettings &) const = default;
};

/// Fixed-window hidden-Markov-model detection: conventional Viterbi line search, block after block.
///
///   u(n, t0) = λ(n, t0),   u(n, t) = λ(n, t) + max_m [ ln P(n|m) + u(m, t-1) ],   t0 < t < t0 + B
///
/// The recursion of the sequential Markov detector without reset, restarted every B frames. The decision is made at a
/// block's end: D = max over a cell's rates there, and -∞ in the frames between. Source: Billon 2005 section 2. Oracle:
/// enumeration of all paths of a block.
class BlockViterbi final : public Detector
{
public:
    /// `phase`: number of frames of the first block that precede the first frame; this block is shorter by as many.
    BlockViterbi(const MarkovModel &model, Index framesPerBlock, Index phase = 0);

    void update(std::span<const float> y, std::span<float> statistic) override;
    /// Restarts the cells' paths without evidence.
    void forget(const Grid &grid, const CellBox &box) override { m_smd.forget(grid, box); }
    void useThreads(int threads) override { m_smd.useThreads(threads); }

private:
    Smd m_smd;
    std::shared_ptr<const DetectorState> m_beginning;
    Index m_framesPerBlock;
    Index m_frame; ///< in the block
};

} // namespace faintline
