#pragma once

#include "base/Checkpoints.h"
#include "plan/Analysis.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace faintline {

/// Repeats an analysis's chain frame by frame, and returns to earlier frames through checkpoints.
///
/// Starts at the run's checkpoint before the requested frames. Between such starts it stores the chain's state every
/// `interval()` frames, within the byte budget, so that going back costs at most one interval. The scores are bit for
/// bit those of the run. A detector that cannot save its state (fixed-window Viterbi and similar) is restarted.
/// Precondition: the analysis lives as long. Use one object per thread.
class Replay
{
public:
    /// Paths: tracks are traced back to their onset, which no score needs.
    enum class Of { Scores, Paths };
    /// Without a byte budget it stores no states of its own.
    explicit Replay(const Analysis &analysis, std::size_t byteBudget = 0, Of what = Of::Scores);

    const DetectionChain &chain() const { return *m_chain; }
    Index next() const { return m_next; } ///< the frame that `step` takes next
    Index interval() const { return m_checkpoints.interval(); }
    Index beginning() const { return m_beginning; } ///< start of the stretch that its own checkpoints cover

    /// Moves to this frame, or to the nearest checkpoint before it unless the current position is nearer.
    void seek(Index frame);

    /// Takes the next frame; returns its statistic.
    std::span<const float> step();
    std::span<const float> statistic() const { return m_statistic; } ///< of the last frame

    /// Takes the frames before `end` and calls visit(frame) after each; `what` is the progress's. Throws Cancelled.
    template <class Visit>
    void stepTo(Index end, const RunContext &context, std::string_view what, const Visit &visit)
    {
        for (const Index first = m_next; m_next < end;) {
            context.checkpoint(double(m_next - first) / double(end - first), what);
            readAhead(end);
            step();
            visit(m_next - 1);
        }
    }
    void stepTo(Index end, const RunContext &context, std::string_view what)
    {
        stepTo(end, context, what, [](Index) {});
    }

private:
    /// Reads the next frame and as many before `end` as make a block, unless it has been read.
    void readAhead(Index end);

    const Analysis *m_analysis;
    std::size_t m_budget;
    Of m_what;
    std::unique_ptr<DetectionChain> m_chain;
    Index m_next = 0;
    Index m_beginning = 0;                 ///< start of the stretch that the checkpoints cover
    Checkpoints<ChainState> m_checkpoints; ///< its own
    std::vector<float> m_block;            ///< frames that were read, …
    Index m_blockBegin = 0;                ///< … from this one on
    std::vector<float> m_statistic;
};

} // namespace faintline
