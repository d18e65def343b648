#pragma once

#include "base/Checkpoints.h"
#include "base/FramePlane.h"
#include "base/memoryShares.h"
#include "inspect/Replay.h"

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

/// Properties of the best state of each cell in one frame, besides its score.
struct CellLayers {
    Index frame = 0;
    std::vector<float> statistic;     ///< D, as displayed by the run
    std::vector<unsigned char> model; ///< index of the bank's model with the best state
    std::vector<std::int32_t> plane;  ///< of the best state; the lowest among equals
    /// Frames since the last reset of the best path, if requested; 0: it was reset in this frame.
    std::vector<std::int32_t> age;
    std::vector<float> resetFraction; ///< fraction of the cell's states that were reset in this frame
    std::vector<char> isInhibited;    ///< inhibited in this frame for a track, or excluded
};

/// Repeats an analysis's chain and determines for each cell which state won and how long its path has continued.
///
///   age(n, t) = 0 if path n was reset in frame t, else 1 + age(m, t-1), m the winning predecessor
///
/// The winner is determined from the scores of two successive frames, m = argmax [ln P(n|m) + u(m, t-1)], with a reset
/// if ln K + that ≤ 0 and ties as in the recursion, so the recursion itself runs only once, in the chain. Axes move
/// independently, so the maximum is taken one axis after the other, and a path's age is carried along with its score. A
/// tracker's paths continue those it was seeded with, without reset. In a bank, each model has its own paths. Oracle:
/// tracePath (age + 1 = steps of its path). For lines and pings alike.
///
/// It begins at a checkpoint of the run, where no path's age is known; a path that was reset since then has a known
/// age. While requested ages are unknown it restarts twice as far back. Cost: the detector's and several times that per
/// frame, over at most twice the age of the oldest requested path and an interval of checkpoints (Replay). Use one
/// object per thread.
class LayerReplay
{
public:
    explicit LayerReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget = memoryShares::layerReplay);

    const std::shared_ptr<const Analysis> &analysis() const { return m_analysis; }

    struct Cells {
        Index begin = 0;
        Index end = std::numeric_limits<Index>::max();
    };

    /// Frame 0 … count-1 (clamped), with the ages of at least these cells; valid until the next call. Throws Cancelled.
    const CellLayers &at(Index frame, const RunContext &context, const Cells &aged);
    const CellLayers &at(Index frame, const RunContext &context = {}) { return at(frame, context, {}); }

private:
    /// By the track's number, then the state.
    using TrackerAges = std::map<int, std::unordered_map<Index, std::int32_t>>;
    struct Ages {
        std::vector<std::vector<std::int32_t>> states; ///< for each model
        TrackerAges trackers;
        Index since = 0; ///< frame from which all paths have been followed

        std::size_t bytes() const;
    };
    /// Runs from `begin` or a checkpoint before it, unless it is already past that.
    void walk(Index begin, Index frame, const RunContext &context);
    void seek(Index frame);
    void forgetAges();
    bool knowsAges(const Cells &cells) const;
    void step();
    std::vector<float> scoresBefore(std::size_t model) const;
    void followPaths(std::size_t model, Index frame);
    void followTrackers();
    std::int32_t oldestAt(Index state, const std::unordered_map<Index, std::int32_t> &ages) const;
    void project(std::span<const float> statistic);

    std::shared_ptr<const Analysis> m_analysis;
    Replay m_replay;
    Index m_now = -1; ///< frame of the ages and layers; -1: none
    std::vector<MarkovModel> m_models;
    Ages m_ages;
    std::vector<std::vector<float>> m_before; ///< each model's scores before the step
    CarriedPaths m_paths;                     ///< scores in the step into the next frame, with the ages of their paths
    CarriedPaths m_moved;
    Index m_beginning = 0;
    Checkpoints<Ages> m_checkpoints; ///< parallel to those of the replay
    CellLayers m_layers;
};

/// A layer displayed instead of the statistic, or over it.
enum class OutputLayer {
    Statistic,  ///< no layer: D itself
    Rate,       ///< winning rate along the first axis shown, in its unit per second
    SecondRate, ///< the same along the second one, for pings
    Age,        ///< path age since the last reset, s
    Reset,      ///< fraction of the cell's states that were reset
    Inhibited,  ///< 1 where the detector was inhibited, else 0
    Presence    ///< of lines: presence of the tracks, over their 5-95 % bands
};
inline constexpr std::array<std::string_view, 7> outputLayerNames{"statistic", "rate",      "bearing-rate", "age",
                                                                  "reset",     "inhibited", "presence"};

/// The displayed part in rows and columns, and the maximum number of either in the picture. For a recording a row is a
/// frame and a column a cell; for one ping a row is a cell of the plane's axis `along`, a column one of `across`.
struct LayerPart {
    Index beginRow = 0, endRow = 0;
    Index beginColumn = 0, endColumn = 0;
    Index mostRows = 1, mostColumns = 1;
    bool operator==(const LayerPart &) const = default;
};

/// Layers of a part, coarsened if it has more rows or columns than the picture may have: a pixel covers `perRow` ×
/// `perColumn` of them, counted from 0, and shows the values of its cell with the largest D, so that a line one bin
/// wide survives. Inhibited: whether any of them is.
struct LayerPicture {
    Index perRow = 1, perColumn = 1;
    Index firstRow = 0, firstColumn = 0;
    Index rows = 0, columns = 0;
    std::vector<float> statistic; ///< rows × columns, as the following
    std::vector<float> rate;
    std::vector<float> secondRate;
    std::vector<float> age;
    std::vector<float> resetFraction;
    std::vector<float> inhibited;
    std::vector<float> presence; ///< of presencePicture, which has no other layer

    const std::vector<float> &values(OutputLayer layer) const;
    /// The pixel that covers a row and column of the part; -1 outside it.
    Index pixelAt(Index row, Index column) const;
};

/// The pixels of a part's picture of `rows` × `columns`, without values.
LayerPicture pixelsOf(const LayerPart &part, Index rows, Index columns);

/// For lines: frames × cells.
LayerPicture layerPicture(LayerReplay &replay, const LayerPart &part, const RunContext &context = {});
/// For a plane of one ping. Its rates are those along the axes shown; of the cells behind a place, the one with the
/// largest D is shown. Precondition: the grid has both axes of the plane.
LayerPicture layerPictureOf(LayerReplay &replay, Index ping, const LayerPart &part, const FramePlane &plane = {},
                            const RunContext &context = {});

/// Tracks as the two-sided second pass sees them (secondLook.h), and nothing else:
///
///   v(t, n) = max over the tracks of presence(t) · share of cell n inside the track's 5-95 % band at t
///
/// The cell nearest to the track's position counts as inside, however narrow the band is. Tracks without a second pass
/// count as present in the cells of their paths. A pixel shows the largest value of its cells. Nothing is run again:
/// the cost is that of the part's pixels and of the tracks' points.
LayerPicture presencePicture(const Analysis &analysis, const LayerPart &part);

/// The largest rate along an axis, in its unit per second; for a bank, over all its models.
double largestRate(const Analysis &analysis, std::size_t axis);

/// Values of one cell.
struct CellReading {
    double ratePerSecond = 0.0;       ///< of its best state, along the first axis shown
    double secondRatePerSecond = 0.0; ///< along the second one, if there is one
    double ageSeconds = 0.0;
    bool isInhibited = false;
    double statistic = 0.0; ///< D
};
CellReading readCell(const Analysis &analysis, const CellLayers &layers, Index cell, const FramePlane &plane = {});
/// Values of one pixel.
CellReading readPixel(const LayerPicture &picture, Index pixel);

} // namespace faintline
