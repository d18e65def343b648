#pragma once

#include "base/RunContext.h"
#include "detect/AxisStep.h"
#include "detect/Departures.h"
#include "detect/SharedMaxima.h"
#include "detect/SlantedTiles.h"
#include "detect/TiledPlanes.h"
#include "detect/finishMax.h"
#include "model/Likelihood.h"
#include "model/StateSpace.h"

#include <algorithm>
#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace faintline {

/// One step of dynamic programming over a kinematic state space, before the new data are added:
///
///   M(n) = ⊕_m F(m) ⊗ P(n | m)
///
/// Every detector of the program stands on this one recursion; they differ in ⊕ (max of logarithms, or sum of weights),
/// in what they join to M (a reset, or nothing) and in how they decide. The axes are independent, so P is a product and
/// ⊕ is taken one axis at a time: a target plane is the join of shifted source planes, all of them in one sweep.
///
/// The cells are gone through in tiles of the slowest axis; within one, all axes' steps are done while it is in cache.
/// A tile that reaches beyond the axis's ends works on a copy with margins, neutral or wrapped round, and later axes on
/// shifted copies of the tile's planes: no inner loop knows an edge. Of equal weights, the maximum over four rates and
/// more is taken from maxima over two and four planes that neighbouring targets share: with r' - r = δ, planes r and r
/// + 2 reach a target a cell apart.
///
/// Along one bounded axis, several frames can be gone through at once (`SlantedTiles`).
///
/// Where rates are fractions of a cell, displacements differ from step to step and repeat after `phaseCount` steps:
/// each phase has tables of its own.
///
/// What differs from cell to cell (a renormalised axis's departures, a full matrix) is ⊗-joined to the scores
/// beforehand (`Departures`).
///
/// Unreached states hold ⊕'s neutral element (-∞, or 0). Cost: states × Σ over axes of moves per target rate; memory is
/// read once and written once. Oracle: enumeration of all paths. Scratch memory belongs to this object: one object per
/// thread.
template <class Semiring>
class Recursion
{
public:
    using Real = typename Semiring::Real;

    explicit Recursion(const StateSpace &space, double transitionScale = 1.0);
    ~Recursion();
    Recursion(Recursion &&) noexcept;
    Recursion &operator=(Recursion &&) noexcept;

    /// ⊕ over predecessors of `scores` (stateCount values) in step number `step`. The answer stays valid until the next
    /// call.
    std::span<Real> predict(std::span<const Real> scores, Index step = 0);

    /// Takes M of the states of one plane in cells firstCell, firstCell + 1, …
    using Tile = std::function<void(Index plane, Index firstCell, std::span<const Real> predicted)>;

    /// The same, handed over tile by tile: each state once, tiles ascending. `scores` must stay as they are until the
    /// end.
    void predict(std::span<const Real> scores, Index step, const Tile &take);

    /// M joined with frames at once: u = λ + max(M + ln K, floor), D = max over rates. `scores` → `next`, which are not
    /// the same memory. Up to `framesAtOnce()`; any number of frames, cut in any way, on any number of threads gives
    /// the same bytes. Answers what went on in the last frame.
    Continued advance(std::span<const float> scores, std::span<float> next, const FrameBlock &frames,
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
    Index m_groupSize;      ///< planes that share one of them
    Index m_rows;           ///< cells of the first axis …
    Index m_inner;          ///< … and of all after it
    bool m_isCyclic;        ///< the first axis
    bool m_isSingle = true; ///< no later axis moves
    std::vector<PhaseSteps<Real>> m_phases;
    SharedMaxima m_maxima; ///< of a single phase
    Index m_slotSize = 0;  ///< of each of them
    std::optional<SlantedTiles> m_slanted;
    std::vector<Continued> m_tileContinued;
    TiledPlanes<Semiring> m_tiled;
    Index m_tileRows = 1; ///< of the largest tile
    int m_threads = 1;
    std::vector<std::unique_ptr<Scratch>> m_scratch;
    std::vector<Real> m_result; ///< empty until it is asked for
    Departures<Semiring> m_departures;
};

extern template class Recursion<MaxPlus<float>>;
extern template class Recursion<MaxPlus<double>>;
extern template class Recursion<SumProduct>;

} // namespace faintline
