#pragma once

#include "analysis/ChainReplay.h"
#include "base/Checkpoints.h"
#include "base/memoryShares.h"
#include "model/MarkovModel.h"

#include <array>
#include <cstdint>
#include <limits>
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
    std::vector<unsigned char> model; ///< of a bank, the one whose state is best
    std::vector<std::int32_t> plane;  ///< of the best state; the lowest among equals
    /// Frames since the last reset of the best path, where asked for; 0: it was reset in this frame.
    std::vector<std::int32_t> age;
    std::vector<float> resetFraction; ///< of the cell's states, those that were reset in this frame
    std::vector<char> isInhibited;    ///< inhibited in this frame for a track, or excluded
};

/// Goes through an analysis's chain again and tells of every cell which state won and for how long its path has gone
/// on.
///
///   age(n, t) = 0 where path n was reset in frame t, else 1 + age(m, t-1), m the predecessor that won
///
/// Who won is read off two successive frames' scores, m = argmax [ln P(n|m) + u(m, t-1)], reset where ln K + that ≤ 0,
/// ties as the recursion decides them: the recursion itself runs once, in the chain. Axes move independently, so the
/// maximum is taken one axis after the other, and a path's age goes along with its score. A tracker's paths go on from
/// those it was seeded with, without reset. Of a bank, each model's paths are its own. Oracle: tracePath (age + 1 =
/// steps of its path). Lines and pings alike.
///
/// It begins at a checkpoint of the run, where no path's age is known; a path that was reset since then has one. While
/// some that are asked for have none it begins again twice as far back. Cost: the detector's and several times that a
/// frame, over at most twice the age of the oldest path asked for and an interval of checkpoints (ChainReplay). One
/// object per thread.
class LayerReplay
{
public:
    explicit LayerReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget = memoryShares::layerReplay);

    const std::shared_ptr<const Analysis> &analysis() const { return m_replay.analysis(); }

    struct Cells {
        Index begin = 0;
        Index end = std::numeric_limits<Index>::max();
    };

    /// Frame 0 … count-1 (clamped), with the ages of those cells at least; valid until the next call. Throws Cancelled.
    const CellLayers &at(Index frame, const RunContext &context, const Cells &aged);
    const CellLayers &at(Index frame, const RunContext &context = {}) { return at(frame, context, {}); }

private:
    /// By the track's number, then the state.
    using TrackerAges = std::map<int, std::unordered_map<Index, std::int32_t>>;
    struct Ages {
        std::vector<std::vector<std::int32_t>> states; ///< of each model
        TrackerAges trackers;
        Index since = 0; ///< frame that all paths have been followed from

        std::size_t bytes() const;
    };
    /// Scores of all states on their way into the next frame, and the ages of the paths that have them.
    struct Paths {
        std::vector<float> scores;
        std::vector<std::int32_t> ages;
    };

    /// From `begin` or a checkpoint before it, unless it is on its way already.
    void walk(Index begin, Index frame, const RunContext &context);
    void seek(Index frame);
    void forgetAges();
    bool knowsAges(const Cells &cells) const;
    void step();
    std::vector<float> scoresBefore(std::size_t model) const;
    void followPaths(std::size_t model, Index frame);
    void followTrackers();
    void project(std::span<const float> statistic);
    static void move(const MarkovModel &model, std::size_t axis, Index step, const Paths &from, Paths &to);

    ChainReplay m_replay;
    Index m_now = -1; ///< frame that ages and layers belong to; -1: none
    std::vector<MarkovModel> m_models;
    Ages m_ages;
    std::vector<std::vector<float>> m_before; ///< each model's scores before the step
    Paths m_paths;
    Paths m_moved;
    Index m_beginning = 0;
    Checkpoints<Ages> m_checkpoints; ///< as the replay's own
    CellLayers m_layers;
};

/// A layer that can be looked at in the place of the statistic, or over it.
enum class OutputLayer {
    Statistic,  ///< none: D itself
    Rate,       ///< winning rate along the first axis, its unit a second
    SecondRate, ///< the same along the second one, of pings
    Age,        ///< path age since the last reset, s
    Reset,      ///< fraction of the cell's states that were reset
    Inhibited   ///< 1 where the detector was kept from the data, else 0
};
inline constexpr std::array<std::string_view, 6> outputLayerNames{"statistic", "rate",  "bearing-rate",
                                                                  "age",       "reset", "inhibited"};

/// What is looked at, in rows and columns, and how many of either the picture may have at most. Of a recording a row is
/// a frame, a column a cell; of one ping a row is a cell of the first axis, a column one of the second.
struct LayerWindow {
    Index beginRow = 0, endRow = 0;
    Index beginColumn = 0, endColumn = 0;
    Index mostRows = 1, mostColumns = 1;
    bool operator==(const LayerWindow &) const = default;
};

/// Layers of a window, made coarser where it has more rows or columns than the picture may have: a pixel stands for
/// `perRow` × `perColumn` of them, counted from 0, and shows the values of the cell whose D is largest among them, so
/// that a line of one bin survives. Inhibited: whether any of them is.
struct LayerPicture {
    Index perRow = 1, perColumn = 1;
    Index firstRow = 0, firstColumn = 0;
    Index rows = 0, columns = 0;
    std::vector<float> statistic; ///< rows × columns, as those below
    std::vector<float> rate;
    std::vector<float> secondRate;
    std::vector<float> age;
    std::vector<float> resetFraction;
    std::vector<float> inhibited;

    const std::vector<float> &values(OutputLayer layer) const;
    /// The pixel that holds a row and column of the window, -1 outside of it.
    Index pixelAt(Index row, Index column) const;
};

/// For lines: frames × cells.
LayerPicture layerPicture(LayerReplay &replay, const LayerWindow &window, const RunContext &context = {});
/// Of one ping. Precondition: the grid has two axes.
LayerPicture layerPictureOf(LayerReplay &replay, Index ping, const LayerWindow &window, const RunContext &context = {});

/// The largest rate along an axis, in its unit a second; of a bank, of all its models.
double largestRate(const Analysis &analysis, std::size_t axis);

/// Of one cell.
struct CellReading {
    double ratePerSecond = 0.0;       ///< of its best state, along the first axis
    double secondRatePerSecond = 0.0; ///< along the second one, where there is one
    double ageSeconds = 0.0;
    bool isInhibited = false;
    double statistic = 0.0; ///< D
};
CellReading readCell(const Analysis &analysis, const CellLayers &layers, Index cell);
/// Values of one pixel.
CellReading readPixel(const LayerPicture &picture, Index pixel);

} // namespace faintline
