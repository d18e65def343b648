#pragma once

#include "base/RunContext.h"
#include "model/Likelihood.h"
#include "model/StateSpace.h"
#include "recursion/AxisStep.h"
#include "recursion/Departures.h"
#include "recursion/SlantedTiles.h"
#include "recursion/finishMax.h"

#include <algorithm>
#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace faintline {

/// One step of dynamic programming over a kinematic state space, before new data are added:
///
///   M(n) = ⊕_m F(m) ⊗ P(n | m)
///
/// All detectors of the program are based on this recursion; they differ in ⊕ (max of logarithms, or sum of weights),
/// in what they join to M (a reset, or nothing) and in how they decide. The axes are independent, so P is a product and
/// ⊕ is applied one axis at a time: a target plane is the join of shifted source planes, all in one sweep.
///
/// The cells are processed in tiles of the slowest axis; in each tile all axes' steps are done while it is in cache. A
/// tile that reaches beyond the axis's ends works on a copy with neutral or wrapped margins, and later axes on shifted
/// copies of the tile's planes, so that no inner loop tests for edges. For equal weights, the maximum over four or more
/// rates is computed from maxima over two and four planes that neighbouring targets share: with r' - r = δ, planes r
/// and r + 2 reach a target a cell apart.
///
/// Along a single bounded axis, several frames can be processed at once (`SlantedTiles`).
///
/// If rates are fractions of a cell, displacements differ from step to step and repeat after `phaseCount` steps; each
/// phase has its own tables.
///
/// Factors that differ from cell to cell (a renormalised axis's departures, a full matrix) are ⊗-joined to the scores
/// beforehand (`Departures`).
///
/// Unreached states hold the neutral element of ⊕ (-∞, or 0). Cost: states × Σ over axes of moves per target rate;
/// memory is read once and written once. Oracle: enumeration of all paths. The object owns its scratch memory: use one
/// object per thread.
template <class Semiring>
class Recursion
{
public:
    using Real = typename Semiring::Real;

    explicit Recursion(const StateSpace &space, double transitionScale = 1.0);
    ~Recursion();
    Recursion(Recursion &&) noexcept;
    Recursion &operator=(Recursion &&) noexcept;

    /// ⊕ over predecessors of `scores` (stateCount values) in step number `step`. The result is valid until the next
    /// call.
    std::span<Real> predict(std::span<const Real> scores, Index step = 0);

    /// Receives M for the states of one plane in cells firstCell, firstCell + 1, …
    using Tile = std::function<void(Index plane, Index firstCell, std::span<const Real> predicted)>;

    /// The same, delivered tile by tile: each state once, tiles ascending. `scores` must not change until the end.
    void predict(std::span<const Real> scores, Index step, const Tile &take);

    /// Computes M and joins it with frames at once: u = λ + max(M + ln K, floor), D = max over rates. Reads `scores`
    /// and writes `next`, which must not overlap, for up to `framesAtOnce()` frames. Any division into calls and any
    /// number of threads gives the same bytes. Returns what continued in each frame; of several frames without sums.
    std::vector<Continued> advance(std::span<const float> scores, std::span<float> next, const FrameBlock &frames,
                                   const Likelihood &likelihood,
                                   const FrameJoin &join) requires std::same_as<Semiring, MaxPlus<float>>;
    Index framesAtOnce() const;

    /// For `advance`.
    void useThreads(int threads) { m_threads = threads; }

private:
    using Source = ShiftedPlane<Real>;

    struct Scratch;

    const PhaseSteps<Real> &phaseOf(Index step) const { return m_phases[std::size_t(step % std::ssize(m_phases))]; }
    Index chooseTileRows(Index reach) const;
    void prepareSlantedTiles() requires std::same_as<Semiring, MaxPlus<float>>;

    void listFirst(const AxisStep<Real> &first, std::span<const Real> scores, Index plane, TileRows rows,
                   Scratch &scratch) const;
    Index slotOf(Index number, Index group) const;
    void slide(std::span<const Real> scores, const SharedMaximum &slide, Index group, TileRows rows,
               Scratch &scratch) const;
    void makeCopies(const AxisStep<Real> &step, Index size, Scratch &scratch) const;
    void joinListed(bool isOnlyStep, Index size, Scratch &scratch) const;
    template <class Finish>
    void goThroughTile(const PhaseSteps<Real> &phase, std::span<const Real> scores, TileRows rows, Scratch &scratch,
                       Finish finish) const;
    Scratch &scratch(std::size_t number);

    Continued advanceOne(const Passage &passage,
                         const RunContext &context) requires std::same_as<Semiring, MaxPlus<float>>;
    Continued advanceTile(const Passage &passage, std::span<const float> scores, TileRows rows,
                          Scratch &scratch) const requires std::same_as<Semiring, MaxPlus<float>>;

    Index m_planeSize;
    Index m_planeCount;
    Index m_groups;         ///< rates of the first axis
    Index m_groupSize;      ///< planes per rate of the first axis
    Index m_rows;           ///< cells of the first axis …
    Index m_inner;          ///< … and of all following axes
    bool m_isCyclic;        ///< of the first axis
    bool m_isSingle = true; ///< no later axis moves
    std::vector<PhaseSteps<Real>> m_phases;
    SharedMaxima m_maxima; ///< for a single phase
    Index m_slotSize = 0;  ///< size of each of them
    std::optional<SlantedTiles> m_slanted;
    std::vector<Continued> m_tileContinued;
    TiledPlanes<Semiring> m_tiled;
    Index m_tileRows = 1; ///< rows of the largest tile
    int m_threads = 1;
    std::vector<std::unique_ptr<Scratch>> m_scratch;
    std::vector<Real> m_result; ///< allocated on first use
    Departures<Semiring> m_departures;
};

extern template class Recursion<MaxPlus<float>>;
extern template class Recursion<MaxPlus<double>>;
extern template class Recursion<SumProduct>;

} // namespace faintline
