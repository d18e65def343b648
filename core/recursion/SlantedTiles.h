#pragma once

#include "base/RunContext.h"
#include "model/Likelihood.h"
#include "recursion/finishMax.h"

#include <span>
#include <vector>

namespace faintline {

/// The frames to process: as many as y holds.
struct FrameBlock {
    std::span<const float> y;
    std::span<float> statistic; ///< D of each frame and cell
    Index firstStep = 0;        ///< number of the step into the first frame
    /// Of each of several frames the cells, ascending, that do not count in what continued and are forgotten before the
    /// next frame: their scores are at most 0 then. Empty: none in any frame.
    std::span<const std::vector<Index>> inhibited{};
};

/// Parameters of the recursion over some frames. `scores` before the first and `next` after the last must not overlap.
struct Passage {
    std::span<const float> scores;
    std::span<float> next;
    const FrameBlock &frames;
    const Likelihood &likelihood;
    const FrameJoin &join;
};

/// The maximum recursion along one bounded axis, several frames at a time (time skewing), so that T frames read and
/// write all scores once.
///
/// Tiles slant by the largest displacement R per frame: the values that a tile needs of the previous frame lie in the
/// tile itself and in the last 2R cells of the previous tile. Two frames of a tile fit into the second-level cache and
/// serve alternately as source and target:
///
///     frame    cells →
///       0      [ tile 0 ][ tile 1 ][ tile 2 ]
///       1    [ tile 0 ][ tile 1 ][ tile 2 ]        begins R cells earlier
///       2  [ tile 0 ][ tile 1 ][ tile 2 ]
///
/// Threads process stretches of cells that overlap by (T-1)·R. Oracle: one frame at a time, to the last bit.
class SlantedTiles
{
public:
    struct RateSource {
        Index rate;
        Index displacement; ///< cells
        float weight;       ///< ln P
    };

    /// The sources of each target rate in the steps of one phase.
    using Targets = std::vector<std::vector<RateSource>>;
    SlantedTiles(Index cells, std::vector<Targets> phases);

    /// Whether two frames of a tile fit into the cache.
    bool areWorthwhile() const;

    /// u = λ + max(M + ln K, floor) for all frames of the passage; returns what continued in each, without sums.
    std::vector<Continued> advance(const Passage &passage, const RunContext &context);

private:
    /// Scratch memory of one thread.
    struct Scratch {
        std::vector<float> windows; ///< two frames of a tile
        std::vector<float> halo;    ///< for each frame: the last columns of the previous tile
        std::vector<float> lambda;
        std::vector<float> unused; ///< a statistic that is not used
        std::vector<const float *> ahead;
    };

    struct Work;
    struct ThreadShare;
    struct TileFrame;
    struct TargetList;

    TargetList listTargets(const Targets &targets, const float *from, float *to, Index toStride) const;
    void listAhead(const Work &work, Index frame, Index first, Index n, std::vector<const float *> &rows) const;
    void readScores(const Work &work, Index begin, float *window) const;
    float *prepareWindows(Scratch &scratch, Index frames) const;
    void goThrough(const Work &work, ThreadShare &stretch, Scratch &scratch) const;
    void fillOutside(const TileFrame &part, const float *halo, float *window) const;
    void joinFrame(const Work &work, const TargetList &list, const TileFrame &part, ThreadShare &stretch,
                   Scratch &scratch) const;
    void inhibit(const Work &work, const TargetList &list, const TileFrame &part, ThreadShare &stretch,
                 std::span<const float> lambda) const;

    Index m_cells;
    std::vector<Targets> m_phases;
    Index m_rates;
    Index m_reach = 0;
    Index m_tileCells; ///< for each rate
    Index m_margin;    ///< before them
    Index m_stride;    ///< between rates
    std::vector<Scratch> m_scratch;
};

} // namespace faintline
