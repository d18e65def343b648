#pragma once

#include "base/memoryShares.h"
#include "inspect/Replay.h"

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace faintline {

/// The scores of all states after one frame, as shown by the statistic: D(cell) = max over the cell's rates.
struct StateScores {
    Index frame = 0;
    std::size_t model = 0;     ///< index in a bank
    std::vector<float> values; ///< StateSpace order, nat; the trackers' scores where they follow something
};

/// Computes the states of an analysis, which does not store them, by repeating its chain up to the requested frame.
///
/// A later frame continues from the current one; the latest frames are cached, so that going back a few steps costs
/// nothing; otherwise it continues from the run's checkpoint before the frame, or a nearer one of its own
/// (Replay). The bytes are those of the run. Memory: one chain, plus states of frames and checkpoints within half
/// of the budget each, at least one. Cost: the detector's per frame. Use one object per thread.
class StateReplay
{
public:
    explicit StateReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget = memoryShares::stateReplay);

    const std::shared_ptr<const Analysis> &analysis() const { return m_analysis; }
    Index interval() const { return m_replay.interval(); } ///< frames between checkpoints

    /// Frame 0 … count-1 (clamped). Throws Cancelled.
    std::shared_ptr<const StateScores> at(Index frame, std::size_t model = 0, const RunContext &context = {});

private:
    std::shared_ptr<const Analysis> m_analysis;
    Replay m_replay;
    std::size_t m_mostKept;
    std::deque<std::shared_ptr<const StateScores>> m_kept;
};

/// The scores of all states after the chain's last frame, as shown by the statistic.
StateScores scoresNow(const Analysis &analysis, const DetectionChain &chain, Index frame, std::size_t model = 0);

/// A score of one of the chain's models as shown by the statistic of its newest frame, to the bit.
float shownScore(const Analysis &analysis, const DetectionChain &chain, std::size_t model, float score);

/// Axes of a state: the grid's axes, then the rate along each of them in its unit per second.
std::vector<Axis> stateAxes(const Analysis &analysis, std::size_t model = 0);

/// A slice through the states along two axes of `stateAxes`; each other axis is fixed, or reduced by the maximum.
struct StateSlice {
    std::size_t rows = 0;
    std::size_t columns = 1;
    /// One per axis; nothing: the maximum over it. Ignored for rows and columns.
    std::vector<std::optional<Index>> places;
    bool operator==(const StateSlice &) const = default;
};

/// rows × columns values; -∞ if no state can be reached.
std::vector<float> cutStates(const StateSpace &space, std::span<const float> scores, const StateSlice &slice);

/// Rate indices of a cell's best state; the lowest among equals.
std::vector<Index> bestRates(const StateSpace &space, std::span<const float> scores, Index cell);

} // namespace faintline
