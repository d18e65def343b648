#pragma once

#include "analysis/ChainReplay.h"
#include "base/memoryShares.h"

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace faintline {

/// The scores of all states after one frame, as the statistic shows them: D(cell) = max over the cell's rates.
struct StateScores {
    Index frame = 0;
    std::size_t model = 0;     ///< of a bank
    std::vector<float> values; ///< StateSpace order, nat; the trackers' scores where they follow something
};

/// Looks into an analysis that kept no states: goes through its chain again up to the frame that is asked for.
///
/// From a frame to a later one it goes on from where it stands; the latest frames are kept, so that a few steps back
/// cost nothing; elsewhere it goes on from the run's checkpoint before, or a nearer one of its own (ChainReplay). Same
/// bytes as in the run. Memory: one chain, and as many frames' states and as many checkpoints as go into half of the
/// budget each, at least one. Cost: the detector's per frame. One object per thread.
class StateReplay
{
public:
    explicit StateReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget = memoryShares::stateReplay);

    const std::shared_ptr<const Analysis> &analysis() const { return m_replay.analysis(); }
    Index interval() const { return m_replay.interval(); } ///< frames between checkpoints

    /// Frame 0 … count-1 (clamped). Throws Cancelled.
    std::shared_ptr<const StateScores> at(Index frame, std::size_t model = 0, const RunContext &context = {});

private:
    ChainReplay m_replay;
    std::size_t m_mostKept;
    std::deque<std::shared_ptr<const StateScores>> m_kept;
};

/// The scores of all states after the chain's last frame, as the statistic shows them.
StateScores scoresNow(const Analysis &analysis, const DetectionChain &chain, Index frame, std::size_t model = 0);

/// A score of a model of the chain as the statistic of its newest frame shows it, to the bit.
float shownScore(const Analysis &analysis, const DetectionChain &chain, std::size_t model, float score);

/// The axes of a state: the grid's axes, then the rate along each of them in its unit a second.
std::vector<Axis> stateAxes(const Analysis &analysis, std::size_t model = 0);

/// A picture through the states: two of the axes of `stateAxes`; each other one at a place, or the maximum over it.
struct StateSlice {
    std::size_t rows = 0;
    std::size_t columns = 1;
    /// One per axis; nothing: the maximum over it. Of rows and columns they do not count.
    std::vector<std::optional<Index>> places;
};

/// rows × columns values; -∞ where no state can be reached.
std::vector<float> cutStates(const StateSpace &space, std::span<const float> scores, const StateSlice &slice);

/// The rates, as indices, of a cell's best state; the lowest among equals.
std::vector<Index> bestRates(const StateSpace &space, std::span<const float> scores, Index cell);

} // namespace faintline
