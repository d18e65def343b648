#pragma once

#include "base/RunContext.h"
#include "detect/SlantedTiles.h"
#include "detect/joinKernels.h"
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

/// The (⊕, ⊗) the recursion runs on. Scores are logarithms under max-plus, plain weights under sum-product.
template <class R>
struct MaxPlus {
    using Real = R;
    static constexpr bool logarithmic = true;
};

struct SumProduct {
    using Real = double;
    static constexpr bool logarithmic = false;
};

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
/// beforehand: P of an axis is (departure of the source) ⊗ (law of the displacement), and the departures of one axis do
/// not mind the moves of another. With rates a departure belongs to a rate and a cell, and scores of a rate with no way
/// on are first ⊕-joined to those it turns to.
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

    /// Frames to go through: as many as y holds.
    struct Frames {
        std::span<const float> y;
        std::span<float> statistic; ///< D of every frame and cell
        Index firstStep = 0;        ///< number of the step into the first of them
    };

    /// M joined with frames at once: u = λ + max(M + ln K, floor), D = max over rates. `scores` → `next`, which are not
    /// the same memory. Up to `framesAtOnce()`; any number of frames, cut in any way, on any number of threads gives
    /// the same bytes. Answers what went on in the last frame.
    Continued advance(std::span<const float> scores, std::span<float> next, const Frames &frames,
                      const Likelihood &likelihood,
                      const FrameJoin &join) requires std::same_as<Semiring, MaxPlus<float>>;
    Index framesAtOnce() const;

    /// For `advance`.
    void useThreads(int threads) { m_threads = threads; }

private:
    using Source = ShiftedPlane<Real>;

    /// An axis with a full matrix; inner: cells of the axes after it.
    struct MatrixStep {
        Index cells;
        Index inner;
        std::vector<Real> weights; ///< from × to
    };

    /// What a renormalised axis with rates does to the scores before its step. after: planes that share the rates up to
    /// this axis.
    struct RateDepartures {
        struct Turn {
            Index cell;
            Index count; ///< cells from there on
            Index fromRate;
            Index toRate;
        };
        Index cells;
        Index inner;
        Index rates;
        Index after;
        Index edge; ///< cells at either end with departures of their own; those between share one
        struct Phase {
            /// Of every rate: the cells of the low end, one between them, those of the high end.
            std::vector<Real> weights;
            std::vector<Turn> turns;
        };
        std::vector<Phase> phases;

        Index places() const { return std::min(cells, 2 * edge + 1); }
        Index cellOf(Index place) const { return place <= edge ? place : cells - places() + place; }
        Index cellsOf(Index place) const { return place == edge ? cells - places() + 1 : 1; }
    };

    struct Shift {
        /// First axis: a rate, or a maximum (numbered on from the rates); later axes: a plane, or a shifted copy.
        Index from;
        Index cells;
        Real weight; ///< ln P or P
    };

    /// max(of(cell), other(cell - back)) of two rates or maxima, wanted at shifts smallest … largest.
    struct Slide {
        Index number;
        Index of;
        Index other;
        Index back;
        Index smallest;
        Index largest;
    };

    /// How one axis moves. Planes are numbered within the group of those that share the rates of the axes before.
    struct AxisStep {
        Index cells;
        Index inner; ///< cells of the axes after
        bool cyclic;
        /// Of each target plane, lowest source rate first; empty: nothing moves.
        std::vector<std::vector<Shift>> shifts;
        std::vector<Shift> copies{}; ///< of a later axis: planes that are wanted shifted, numbered on from the planes
    };

    /// How all axes move in the steps of one phase.
    struct Phase {
        AxisStep first;
        std::vector<AxisStep> later{};
    };

    /// Cells of the first axis that are dealt with at a time.
    struct TileRows {
        Index first;
        Index count;
    };

    struct Scratch;

    void addPhase(const StateSpace &space, Index number, double transitionScale);
    AxisStep firstAxis(const KinematicAxis &axis, Index number, Index inner, double transitionScale);
    AxisStep laterAxis(const KinematicAxis &axis, Index number, Index inner, Index before, Index after,
                       double transitionScale) const;
    const Phase &phaseOf(Index step) const { return m_phases[std::size_t(step % std::ssize(m_phases))]; }
    void prepareSlides();
    void prepareTiles();
    void prepareSlantedTiles() requires std::same_as<Semiring, MaxPlus<float>>;
    void preparePlaces(const StateSpace &space, double transitionScale);
    std::span<const Real> prepare(std::span<const Real> scores, Index step);
    void apply(const MatrixStep &step, std::span<const Real> from, std::span<Real> to) const;
    void apply(const RateDepartures &departures, Index step, std::span<Real> scores) const;

    void fillMargins(std::span<const Real> scores);
    const Real *rowsOf(std::span<const Real> scores, Index plane, Index firstRow) const;
    void listFirst(const AxisStep &first, std::span<const Real> scores, Index rate, Index group, TileRows rows,
                   Scratch &scratch) const;
    Index slotOf(Index number, Index group) const;
    void slide(std::span<const Real> scores, const Slide &slide, Index group, TileRows rows, Scratch &scratch) const;
    void makeCopies(const AxisStep &step, Index size, Scratch &scratch) const;
    template <class Finish>
    void goThroughTile(const Phase &phase, std::span<const Real> scores, TileRows rows, Scratch &scratch,
                       Finish finish) const;
    Scratch &scratch(std::size_t number);

    Continued advanceOne(std::span<const float> scores, std::span<float> next, const Frames &frames,
                         const Likelihood &likelihood, const FrameJoin &join,
                         const RunContext &context) requires std::same_as<Semiring, MaxPlus<float>>;
    void joinListed(bool isOnlyStep, Index size, Scratch &scratch) const;

    Index m_planeSize;
    Index m_planeCount;
    Index m_groups;         ///< rates of the first axis
    Index m_groupSize;      ///< planes that share one of them
    Index m_reach = 0;      ///< largest displacement along the first axis
    Index m_rows;           ///< cells of the first axis …
    Index m_inner;          ///< … and of all after it
    bool m_isCyclic;        ///< the first axis
    bool m_isSingle = true; ///< no later axis moves
    std::vector<Phase> m_phases;
    /// Before each target rate, in the order they are made in; of a single phase.
    std::vector<std::vector<Slide>> m_slides;
    Index m_slideRing = 0; ///< rates whose maxima are kept at a time; 0: there are none
    Index m_slotSize = 0;
    std::vector<Index> m_largest; ///< shift that each maximum is wanted at
    std::optional<SlantedTiles> m_slanted;
    std::vector<Continued> m_tileContinued;
    std::vector<TileRows> m_tiles;
    Index m_tileRows = 1;        ///< of the largest tile
    Index m_edgeRows = 0;        ///< tiles that begin nearer to an end of the first axis, or end there, use the margins
    std::vector<Real> m_margins; ///< of each plane: the rows round either end, or all of them
    int m_threads = 1;
    std::vector<std::unique_ptr<Scratch>> m_scratch;
    std::vector<Real> m_result;     ///< empty until it is asked for
    std::vector<Real> m_departures; ///< of every cell; empty where the law is the same everywhere
    std::vector<RateDepartures> m_rateDepartures;
    std::vector<MatrixStep> m_matrices;
    std::vector<Real> m_prepared;
    std::vector<Real> m_multiplied;
};

extern template class Recursion<MaxPlus<float>>;
extern template class Recursion<MaxPlus<double>>;
extern template class Recursion<SumProduct>;

} // namespace faintline
