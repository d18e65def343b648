#pragma once

#include "base/RunContext.h"
#include "detect/joinKernels.h"
#include "model/Likelihood.h"

#include <span>
#include <vector>

namespace faintline {

/// The maximum recursion along one bounded axis, several frames at a time, so that T frames cost one reading and one
/// writing of all scores.
///
/// Tiles slant by the largest displacement R a frame: what one needs of the frame before lies in the tile itself and in
/// the last 2R cells of the tile before. Two frames of a tile lie in the second-level cache, in turns source and
/// target:
///
///     frame    cells →
///       0      [ tile 0 ][ tile 1 ][ tile 2 ]
///       1    [ tile 0 ][ tile 1 ][ tile 2 ]        begins R cells earlier
///       2  [ tile 0 ][ tile 1 ][ tile 2 ]
///
/// Threads take stretches of cells that overlap by (T-1)·R. Oracle: one frame at a time, to the last bit.
class SlantedTiles
{
public:
    struct Source {
        Index rate;
        Index displacement; ///< cells
        float weight;       ///< ln P
    };

    /// The sources of every target rate in the steps of one phase.
    using Targets = std::vector<std::vector<Source>>;
    SlantedTiles(Index cells, std::vector<Targets> phases);

    /// Whether two frames of a tile fit into the cache.
    bool areWorthwhile() const;

    /// u = λ + max(M + ln K, floor) of as many frames as `y` holds, D of each in `statistic`; answers what went on in
    /// the last. `firstStep`: number of the step into the first of them.
    Continued advance(std::span<const float> scores, std::span<float> next, std::span<const float> y,
                      std::span<float> statistic, Index firstStep, const Likelihood &likelihood, const FrameJoin &join,
                      const RunContext &context);

private:
    /// Of one thread.
    struct Scratch {
        std::vector<float> windows; ///< two frames of a tile
        std::vector<float> halo;    ///< of every frame: the last columns of the tile before
        std::vector<float> lambda;
        std::vector<float> unused; ///< a statistic that is not used
        std::vector<const float *> ahead;
    };

    struct Work;
    struct Stretch;
    struct TargetList;

    TargetList listTargets(const Targets &targets, const float *from, float *to, Index toStride) const;
    void listAhead(const Work &work, Index frame, Index first, Index n, std::vector<const float *> &rows) const;
    void readScores(const Work &work, Index begin, float *window) const;
    void goThrough(const Work &work, Stretch &stretch, Scratch &scratch) const;

    Index m_cells;
    std::vector<Targets> m_phases;
    Index m_rates;
    Index m_reach = 0;
    Index m_tileCells; ///< of each rate
    Index m_margin;    ///< before them
    Index m_stride;    ///< from rate to rate
    std::vector<Scratch> m_scratch;
};

} // namespace faintline
