#pragma once

#include "analysis/ChainReplay.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace faintline {

/// What the best state of each cell is in one frame, besides its score.
struct CellLayers {
    Index frame = 0;
    std::vector<float> statistic;     ///< D, as the run showed it
    std::vector<std::int32_t> plane;  ///< of the best state; the lowest among equals
    std::vector<std::int32_t> age;    ///< frames since the last reset of the best path; 0: it was reset in this frame
    std::vector<float> resetFraction; ///< of the cell's states, those that were reset in this frame
    std::vector<char> isInhibited;    ///< kept from the detector in this frame, for a track or as a blind place
};

/// Goes through an analysis's chain again and tells of every cell which state won and for how long its path has gone on.
///
///   age(n, t) = 0 where path n was reset in frame t, else 1 + age(m, t-1), m the predecessor that won
///
/// Who won is read off two successive frames' scores, m = argmax [ln P(n|m) + u(m, t-1)], reset where ln K + that ≤ 0, ties as the
/// recursion decides them: the recursion itself runs once, in the chain. A tracker's paths go on from those it was seeded with, without
/// reset. Oracle: tracePath (age + 1 = steps of its path). For lines, whose grid has one axis. Cost: the detector's and as much again per
/// frame; going back costs an interval of checkpoints at most (ChainReplay). One object per thread.
class LayerReplay
{
public:
    explicit LayerReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget = std::size_t(128) << 20);

    const std::shared_ptr<const Analysis> &analysis() const { return m_replay.analysis(); }

    /// Frame 0 … count-1 (clamped), valid until the next call. Throws Cancelled.
    const CellLayers &at(Index frame, const RunContext &context = {});

private:
    using TrackerAges = std::map<int, std::unordered_map<Index, std::int32_t>>; ///< by the track's number, then the state
    struct Ages {
        std::vector<std::int32_t> states;
        TrackerAges trackers;
    };

    void seek(Index frame);
    void step();
    std::vector<float> scoresBefore() const;
    void followPaths(std::span<const float> before);
    void followTrackers();
    void project(std::span<const float> statistic);

    ChainReplay m_replay;
    Index m_now = -1; ///< frame that ages and layers belong to; -1: none
    Ages m_ages;
    std::vector<std::int32_t> m_agesBefore;
    std::map<Index, std::shared_ptr<const Ages>> m_checkpoints; ///< by the frame that comes next
    CellLayers m_layers;
};

/// A layer that can be looked at in the place of the statistic, or over it.
enum class OutputLayer {
    Statistic, ///< none: D itself
    Rate,      ///< winning rate, the axis's unit a second
    Age,       ///< path age since the last reset, s
    Reset,     ///< fraction of the cell's states that were reset
    Inhibited  ///< 1 where the detector was kept from the data, else 0
};
inline constexpr std::array<std::string_view, 5> outputLayerNames{"statistic", "rate", "age", "reset", "inhibited"};

/// What of a recording is looked at, in frames and cells; rows and columns the picture may have at most.
struct LayerWindow {
    Index beginFrame = 0, endFrame = 0;
    Index beginCell = 0, endCell = 0;
    Index mostRows = 1, mostColumns = 1;
    bool operator==(const LayerWindow &) const = default;
};

/// Layers of a window, made coarser where it has more frames or cells than the picture rows or columns: a row stands for `framesPerRow`
/// frames, a column for `cellsPerColumn` cells, both counted from 0, and each shows the values of the cell whose D is largest among
/// them, so that a line of one bin survives. Inhibited: whether any of them is.
struct LayerPicture {
    Index framesPerRow = 1, cellsPerColumn = 1;
    Index firstRow = 0, firstColumn = 0;
    Index rows = 0, columns = 0;
    std::vector<float> statistic; ///< rows × columns, as those below
    std::vector<float> rate;
    std::vector<float> age;
    std::vector<float> resetFraction;
    std::vector<float> inhibited;

    const std::vector<float> &values(OutputLayer layer) const;
};
LayerPicture layerPicture(LayerReplay &replay, const LayerWindow &window, const RunContext &context = {});

/// Of one cell.
struct CellReading {
    double ratePerSecond = 0.0; ///< of its best state
    double ageSeconds = 0.0;
    bool isInhibited = false;
    double statistic = 0.0; ///< D
};
CellReading readCell(const Analysis &analysis, const CellLayers &layers, Index cell);

} // namespace faintline
