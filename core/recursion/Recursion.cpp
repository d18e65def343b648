#include "recursion/Recursion.h"

#include "base/parallel.h"

#include <algorithm>
#include <utility>

namespace faintline {

namespace {

    constexpr Index tileCells = 1024;     ///< of each plane in a tile
    constexpr Index longTileCells = 2048; ///< the same for a single axis, which needs no second step
    /// The smallest tile, used with many planes, so that those of the next tile also fit into the cache.
    constexpr Index fewestCells = 256;
    constexpr Index tileBytes = 1 << 19; ///< read and written, for all planes of a tile
    constexpr Index vectorCells = 32;
    constexpr Index manyFrames = 16;                ///< processed at a time; memory traffic is then negligible
    constexpr Index stateFramesPerThread = 1 << 19; ///< states × frames

    /// Prefetches memory for the next tile, because there are many planes, whose pieces are too short for the hardware
    /// prefetcher.
    template <bool toWrite>
    void fetch(const void *begin, Index bytes)
    {
        constexpr Index line = 64;
        for (Index at = 0; at < bytes; at += line)
            __builtin_prefetch(static_cast<const char *>(begin) + at, toWrite ? 1 : 0, 2);
    }

} // namespace

template <class Semiring>
struct Recursion<Semiring>::Scratch {
    std::vector<Real> slides; ///< rows of each maximum in a tile
    std::vector<Real> tile;   ///< planes of a group in a tile, after an axis's step
    std::vector<Real> otherTile;
    std::vector<Real> copies;
    std::vector<const Real *> planes; ///< input of the next axis
    std::vector<Source> sources;
    std::vector<std::size_t> firstSource; ///< for each target, and one past the last
    std::vector<TargetPlane> targets;
    std::vector<float> lambda;

    void clearSources()
    {
        sources.clear();
        firstSource.assign(1, 0);
    }
    void endTarget() { firstSource.push_back(sources.size()); }
    std::span<const Source> sourcesOf(std::size_t target) const
    {
        return std::span(sources).subspan(firstSource[target], firstSource[target + 1] - firstSource[target]);
    }
};

template <class Semiring>
Recursion<Semiring>::~Recursion() = default;

template <class Semiring>
Recursion<Semiring>::Recursion(Recursion &&) noexcept = default;

template <class Semiring>
Recursion<Semiring> &Recursion<Semiring>::operator=(Recursion &&) noexcept = default;

template <class Semiring>
Recursion<Semiring>::Recursion(const StateSpace &space, double transitionScale)
    : m_planeSize(space.cellCount()), m_planeCount(space.planeCount()), m_groups(space.axes().front().rateCount),
      m_groupSize(m_planeCount / m_groups), m_rows(space.axes().front().cells), m_inner(m_planeSize / m_rows),
      m_isCyclic(space.axes().front().cyclic), m_departures(space, transitionScale)
{
    Index reach = 0;
    for (Index number = 0; number < space.phaseCount(); ++number) {
        m_phases.push_back(stepsOfPhase<Semiring>(space, number, transitionScale));
        reach = std::max(reach, m_phases.back().reach());
        m_isSingle = m_isSingle && m_phases.back().later.empty();
    }
    m_maxima.before.resize(std::size_t(m_groups));
    if constexpr (Semiring::logarithmic)
        if (m_phases.size() == 1 && !m_phases.front().first.shifts.empty()) // single: all targets are finished together
            m_maxima = shareMaxima(m_phases.front().first, m_isSingle);
    m_tileRows = chooseTileRows(reach);
    m_tiled = {{m_planeCount, m_rows, m_inner, m_isCyclic}, reach, m_tileRows};
    m_slotSize = (m_tileRows + m_maxima.longestSpan()) * m_inner;
    if constexpr (std::same_as<Semiring, MaxPlus<float>>)
        if (space.axes().size() == 1)
            prepareSlantedTiles();
}

template <class Semiring>
Index Recursion<Semiring>::chooseTileRows(Index reach) const
{
    const Index fitting = std::clamp(tileBytes / (2 * m_planeCount * Index(sizeof(Real))), fewestCells, tileCells);
    const bool isSingle = m_planeCount == m_groups && m_isSingle;
    // Shared maxima need more rows than the tile has, which is too expensive for short tiles.
    const Index cells = isSingle ? longTileCells : m_maxima.ring > 0 ? tileCells : fitting;
    const Index most = std::clamp<Index>(cells / m_inner, 1, m_rows);
    Index chosen = most;
    // Whole vectors, if possible.
    for (Index rows = most; rows > 0 && most < m_rows; --rows)
        if (rows * m_inner % vectorCells == 0) {
            chosen = rows;
            break;
        }
    // For a wide law, only sources that exist for some row of a tile count.
    return 4 * reach > m_rows ? std::min<Index>(chosen, 8) : chosen;
}

template <class Semiring>
void Recursion<Semiring>::prepareSlantedTiles() requires std::same_as<Semiring, MaxPlus<float>>
{
    if constexpr (std::same_as<Semiring, MaxPlus<float>>) { // clang 14 instantiates it for others as well
        if (m_isCyclic || m_maxima.ring > 0 || !m_departures.areNone())
            return;
        std::vector<SlantedTiles::Targets> phases;
        for (const PhaseSteps<Real> &phase : m_phases) {
            SlantedTiles::Targets &targets = phases.emplace_back(std::size_t(m_groups));
            for (Index rate = 0; rate < m_groups; ++rate) {
                std::vector<SlantedTiles::RateSource> &sources = targets[std::size_t(rate)];
                if (phase.first.shifts.empty())
                    sources.push_back({rate, 0, 0.0f});
                else
                    for (const Shift<Real> &shift : phase.first.shifts[std::size_t(rate)])
                        sources.push_back({shift.from, shift.cells, shift.weight});
            }
        }
        if (SlantedTiles tiles(m_rows, std::move(phases)); tiles.areWorthwhile())
            m_slanted = std::move(tiles);
    }
}

template <class Semiring>
typename Recursion<Semiring>::Scratch &Recursion<Semiring>::scratch(std::size_t number)
{
    while (m_scratch.size() <= number) {
        auto made = std::make_unique<Scratch>();
        const auto planes = std::size_t(m_groupSize);
        const auto size = std::size_t(m_tileRows * m_inner);
        std::size_t copies = 0;
        for (const PhaseSteps<Real> &phase : m_phases)
            for (const AxisStep<Real> &step : phase.later)
                copies = std::max(copies, step.copies.size());
        made->tile.resize(planes * size);
        made->otherTile.resize(planes * size);
        made->copies.resize(copies * size);
        made->lambda.resize(size);
        made->slides.resize(std::size_t(2 * m_maxima.ring * m_groupSize * m_slotSize));
        m_scratch.push_back(std::move(made));
    }
    return *m_scratch[number];
}

template <class Semiring>
std::span<typename Semiring::Real> Recursion<Semiring>::predict(std::span<const Real> scores, Index step)
{
    m_result.resize(std::size_t(m_planeSize * m_planeCount));
    predict(scores, step, [this](Index plane, Index firstCell, std::span<const Real> predicted) {
        std::copy(predicted.begin(), predicted.end(), m_result.begin() + plane * m_planeSize + firstCell);
    });
    return m_result;
}

template <class Semiring>
void Recursion<Semiring>::predict(std::span<const Real> scores, Index step, const Tile &take)
{
    scores = m_departures.apply(scores, step);
    m_tiled.fillMargins(scores);
    Scratch &own = scratch(0);
    std::vector<Real> predicted(std::size_t(m_tileRows * m_inner));
    for (const TileRows &rows : m_tiled.tiles())
        goThroughTile(phaseOf(step), scores, rows, own, [&](Index firstPlane) {
            const std::span<Real> to = std::span(predicted).first(std::size_t(rows.count * m_inner));
            for (std::size_t k = 0; k + 1 < own.firstSource.size(); ++k) {
                joinSources<Semiring>(to.data(), std::ssize(to), own.sourcesOf(k));
                take(firstPlane + Index(k), rows.first * m_inner, to);
            }
        });
}

/// Slot of a maximum: maxima reuse the slots of rates that are out of the law's reach.
template <class Semiring>
Index Recursion<Semiring>::slotOf(Index number, Index group) const
{
    const Index level = number / m_groups - 1; // over two, over four
    return (level * m_maxima.ring + number % m_groups % m_maxima.ring) * m_groupSize + group;
}

/// Computes one maximum for the rows of a tile.
template <class Semiring>
void Recursion<Semiring>::slide(std::span<const Real> scores, const SharedMaximum &slide, Index group, TileRows rows,
                                Scratch &own) const
{
    if constexpr (Semiring::logarithmic) {
        const Index inner = m_inner;
        const auto place = [&](Index number) { return own.slides.data() + slotOf(number, group) * m_slotSize; };
        const Index firstRow = -slide.largest; // relative to the tile
        const auto from = [&](Index number, Index back) -> const Real * {
            if (number < m_groups)
                return m_tiled.rowsOf(scores, number * m_groupSize + group, rows.first) + (firstRow - back) * inner;
            return place(number) + (firstRow - back + m_maxima.largest[std::size_t(number - m_groups)]) * inner;
        };
        const Index count = rows.count + slide.largest - slide.smallest;
        maxOfTwo(place(slide.number), from(slide.of, 0), from(slide.other, slide.back), count * inner);
    }
}

/// The sources of one target plane of the first axis, for the rows of a tile.
template <class Semiring>
void Recursion<Semiring>::listFirst(const AxisStep<Real> &first, std::span<const Real> scores, Index plane,
                                    TileRows rows, Scratch &own) const
{
    const Index inner = m_inner;
    if (first.shifts.empty()) {
        own.sources.push_back({m_tiled.rowsOf(scores, plane, rows.first), weightOf<Semiring>(0.0)});
        return;
    }
    const Index group = plane % m_groupSize;
    for (const Shift<Real> &shift : first.shifts[std::size_t(plane / m_groupSize)]) {
        if (shift.from >= m_groups) {
            const auto number = std::size_t(shift.from - m_groups);
            const Real *maxima = own.slides.data() + slotOf(shift.from, group) * m_slotSize;
            own.sources.push_back({maxima + (m_maxima.largest[number] - shift.cells) * inner, shift.weight});
        } else if (m_isCyclic || (rows.first - shift.cells < m_rows && rows.first + rows.count - shift.cells > 0)) {
            own.sources.push_back(
                {m_tiled.rowsOf(scores, shift.from * m_groupSize + group, rows.first) - shift.cells * inner,
                 shift.weight});
        }
    }
}

/// Makes shifted copies of the planes from which a later axis starts.
template <class Semiring>
void Recursion<Semiring>::makeCopies(const AxisStep<Real> &step, Index size, Scratch &own) const
{
    for (std::size_t number = 0; number < step.copies.size(); ++number) {
        const Shift<Real> &copy = step.copies[number];
        const Real *from = own.planes[std::size_t(copy.from)];
        Real *to = own.copies.data() + Index(number) * size;
        shiftCells<Semiring>(step, copy.cells, std::span(from, std::size_t(size)), to);
        own.planes.push_back(to);
    }
}

/// Performs all axes' steps for the rows of a tile. `finish(plane)` is called with the first of the target planes whose
/// sources have been listed.
template <class Semiring>
template <class Finish>
void Recursion<Semiring>::goThroughTile(const PhaseSteps<Real> &phase, std::span<const Real> scores, TileRows rows,
                                        Scratch &own, Finish finish) const
{
    const Index bytes = rows.count * m_inner * Index(sizeof(Real));
    own.clearSources();
    for (Index rate = 0; rate < m_groups; ++rate) {
        for (const SharedMaximum &s : m_maxima.before[std::size_t(rate)])
            for (Index group = 0; group < m_groupSize; ++group)
                slide(scores, s, group, rows, own);
        if (!phase.later.empty())
            own.clearSources();
        for (Index group = 0; group < m_groupSize; ++group) {
            if (const Index ahead = rows.first + rows.count; ahead + rows.count <= m_rows)
                fetch<false>(scores.data() + (rate * m_groupSize + group) * m_planeSize + ahead * m_inner, bytes);
            listFirst(phase.first, scores, rate * m_groupSize + group, rows, own);
            own.endTarget();
        }
        if (phase.later.empty())
            continue;
        const Index size = rows.count * m_inner;
        for (const AxisStep<Real> &step : phase.later) {
            joinListed(phase.later.size() == 1, size, own);
            makeCopies(step, size, own);
            own.clearSources();
            for (const std::vector<Shift<Real>> &shifts : step.shifts) {
                for (const Shift<Real> &shift : shifts)
                    own.sources.push_back({own.planes[std::size_t(shift.from)], shift.weight});
                own.endTarget();
            }
        }
        finish(rate * m_groupSize);
    }
    if (phase.later.empty())
        finish(0);
}

/// Joins the sources of each listed target to a plane; a target that would be a mere copy uses the source plane itself.
template <class Semiring>
void Recursion<Semiring>::joinListed(bool isOnlyStep, Index size, Scratch &own) const
{
    std::swap(own.tile, own.otherTile);
    own.planes.clear();
    for (Index group = 0; group < m_groupSize; ++group) {
        const std::span<const Source> sources = own.sourcesOf(std::size_t(group));
        if (sources.size() == 1 && sources.front().weight == weightOf<Semiring>(0.0) && isOnlyStep) {
            own.planes.push_back(sources.front().from);
            continue;
        }
        Real *to = own.tile.data() + group * size;
        joinSources<Semiring>(to, size, sources);
        own.planes.push_back(to);
    }
}

template <class Semiring>
Index Recursion<Semiring>::framesAtOnce() const
{
    return m_slanted ? manyFrames : 1;
}

template <class Semiring>
std::vector<Continued>
Recursion<Semiring>::advance(std::span<const float> scores, std::span<float> next, const FrameBlock &frames,
                             const Likelihood &likelihood,
                             const FrameJoin &join) requires std::same_as<Semiring, MaxPlus<float>>
{
    if constexpr (std::same_as<Semiring, MaxPlus<float>>) { // clang 14 instantiates it for others as well
        RunContext context;
        const Index work = std::ssize(frames.y) * m_planeCount;
        context.threads = int(std::clamp<Index>(work / stateFramesPerThread, 1, m_threads));
        const Passage passage{scores, next, frames, likelihood, join};
        if (std::ssize(frames.y) > m_planeSize)
            return m_slanted->advance(passage, context);
        return {advanceOne(passage, context)};
    } else {
        return {};
    }
}

template <class Semiring>
Continued Recursion<Semiring>::advanceOne(const Passage &passage,
                                          const RunContext &context) requires std::same_as<Semiring, MaxPlus<float>>
{
    if constexpr (std::same_as<Semiring, MaxPlus<float>>) { // clang 14 instantiates it for others as well
        const std::span<const float> scores = m_departures.apply(passage.scores, passage.frames.firstStep);
        m_tiled.fillMargins(scores);
        const Index count = std::ssize(m_tiled.tiles());
        m_tileContinued.assign(std::size_t(count), {});
        // Each thread gets a stretch of tiles and prefetches its next tile.
        scratch(std::size_t(context.threads) - 1);
        parallelFor(context.threads, context, "recursion", [&] {
            return [&](Index thread) {
                for (Index number = thread * count / context.threads; number < (thread + 1) * count / context.threads;
                     ++number)
                    m_tileContinued[std::size_t(number)] = advanceTile(
                        passage, scores, m_tiled.tiles()[std::size_t(number)], *m_scratch[std::size_t(thread)]);
            };
        });
        Continued all;
        for (const Continued &part : m_tileContinued) { // in this order, because the sum is in floating point
            all.count += part.count;
            all.sum += part.sum;
        }
        return all;
    } else {
        return {};
    }
}

template <class Semiring>
Continued Recursion<Semiring>::advanceTile(const Passage &passage, std::span<const float> scores, TileRows rows,
                                           Scratch &own) const requires std::same_as<Semiring, MaxPlus<float>>
{
    if constexpr (std::same_as<Semiring, MaxPlus<float>>) { // clang 14 instantiates it for others as well
        const Index firstCell = rows.first * m_inner;
        const Index n = rows.count * m_inner;
        passage.likelihood.apply(passage.frames.y.subspan(std::size_t(firstCell), std::size_t(n)),
                                 std::span(own.lambda).first(std::size_t(n)));
        Continued continued;
        goThroughTile(phaseOf(passage.frames.firstStep), scores, rows, own, [&](Index firstPlane) {
            own.targets.clear();
            for (std::size_t k = 0; k + 1 < own.firstSource.size(); ++k) {
                float *const to = passage.next.data() + (firstPlane + Index(k)) * m_planeSize;
                own.targets.push_back({own.sourcesOf(k), to});
                if (firstCell + 2 * n <= m_planeSize)
                    fetch<true>(to + firstCell + n, n * Index(sizeof(float)));
            }
            FrameJoin joined = passage.join;
            joined.isFresh = firstPlane == 0;
            const Continued part = finishMax(own.targets, {n, 0, firstCell}, own.lambda.data(), joined,
                                             passage.frames.statistic.data() + firstCell);
            continued.count += part.count;
            continued.sum += part.sum;
        });
        return continued;
    } else {
        return {};
    }
}

template class Recursion<MaxPlus<float>>;
template class Recursion<MaxPlus<double>>;
template class Recursion<SumProduct>;

} // namespace faintline
