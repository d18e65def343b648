#include "detect/Recursion.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace faintline {

namespace {

    constexpr Index tileCells = 1024;     ///< of each plane of a tile
    constexpr Index longTileCells = 2048; ///< the same where a single axis needs no second step
    /// The same where planes are so many that the next tile's would not fit into the cache beside them.
    constexpr Index fewestCells = 256;
    constexpr Index tileBytes = 1 << 19; ///< of all planes of a tile, read and written
    constexpr Index vectorCells = 32;
    constexpr Index manyFrames = 16;        ///< gone through at a time: then the memory has become as good as free
    constexpr std::size_t fewest = 4;       ///< rates whose maximum is worth sharing
    constexpr Index worthAThread = 1 << 19; ///< states × frames

    template <class Semiring>
    constexpr typename Semiring::Real nothing()
    {
        if constexpr (Semiring::logarithmic)
            return -std::numeric_limits<typename Semiring::Real>::infinity();
        else
            return 0;
    }

    template <class Semiring>
    void joinSources(typename Semiring::Real *to, Index n,
                     std::span<const ShiftedPlane<typename Semiring::Real>> sources)
    {
        if constexpr (Semiring::logarithmic)
            joinMax(to, n, sources);
        else
            joinSum(to, n, sources);
    }

    template <class Semiring>
    void depart(typename Semiring::Real *to, const typename Semiring::Real *departures, Index n)
    {
        if constexpr (Semiring::logarithmic)
            addEach(to, departures, n);
        else
            multiplyEach(to, departures, n);
    }

    /// Asks for memory that the next tile will read or write: planes are many, and pieces of them too short for the
    /// processor to foresee.
    template <bool toWrite>
    void fetch(const void *begin, Index bytes)
    {
        constexpr Index line = 64;
        for (Index at = 0; at < bytes; at += line)
            __builtin_prefetch(static_cast<const char *>(begin) + at, toWrite ? 1 : 0, 2);
    }

    /// An axis that never moves and loses no probability needs no step of its own.
    bool isIdentity(const std::vector<KinematicAxis::Move> &moves)
    {
        return std::all_of(moves.begin(), moves.end(), [](const KinematicAxis::Move &m) {
            return m.fromRate == m.toRate && m.cells == 0 && m.lnProbability == 0.0;
        });
    }

    template <class Semiring>
    typename Semiring::Real weightOf(double lnProbability)
    {
        return static_cast<typename Semiring::Real>(Semiring::logarithmic ? lnProbability : std::exp(lnProbability));
    }

} // namespace

template <class Semiring>
struct Recursion<Semiring>::Scratch {
    std::vector<Real> slides; ///< each maximum's rows of a tile
    std::vector<Real> tile;   ///< a group's planes of a tile, after an axis's step
    std::vector<Real> otherTile;
    std::vector<Real> copies;
    std::vector<const Real *> planes; ///< what the next axis starts from
    std::vector<Source> sources;
    std::vector<std::size_t> firstSource; ///< of each target, and one beyond the last
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
      m_isCyclic(space.axes().front().cyclic)
{
    for (Index number = 0; number < space.phaseCount(); ++number)
        addPhase(space, number, transitionScale);
    m_slides.resize(std::size_t(m_groups));
    if constexpr (Semiring::logarithmic)
        if (m_phases.size() == 1)
            prepareSlides();
    prepareTiles();
    preparePlaces(space, transitionScale);
    if constexpr (std::same_as<Semiring, MaxPlus<float>>)
        if (space.axes().size() == 1)
            prepareSlantedTiles();
}

template <class Semiring>
void Recursion<Semiring>::addPhase(const StateSpace &space, Index number, double transitionScale)
{
    Phase phase;
    Index inner = space.cellCount();
    Index before = 1;          // rate combinations within a group: of the later axes before this one …
    Index after = m_groupSize; // … and after it
    for (std::size_t axis = 0; axis < space.axes().size(); ++axis) {
        const KinematicAxis &a = space.axes()[axis];
        inner /= a.cells;
        if (axis == 0) {
            phase.first = firstAxis(a, number, inner, transitionScale);
            continue;
        }
        after /= a.rateCount;
        if (!isIdentity(a.moves(number)))
            phase.later.push_back(laterAxis(a, number, inner, before, after, transitionScale));
        before *= a.rateCount;
    }
    m_isSingle = m_isSingle && phase.later.empty();
    m_phases.push_back(std::move(phase));
}

template <class Semiring>
typename Recursion<Semiring>::AxisStep Recursion<Semiring>::firstAxis(const KinematicAxis &axis, Index number,
                                                                      Index inner, double transitionScale)
{
    AxisStep step{axis.cells, inner, axis.cyclic, {}};
    const std::vector<KinematicAxis::Move> moves = axis.moves(number);
    if (isIdentity(moves))
        return step;
    step.shifts.resize(std::size_t(axis.rateCount));
    for (const KinematicAxis::Move &move : moves) {
        step.shifts[std::size_t(move.toRate)].push_back(
            {move.fromRate, move.cells, weightOf<Semiring>(move.lnProbability * transitionScale)});
        m_reach = std::max<Index>(m_reach, std::abs(move.cells));
    }
    return step;
}

template <class Semiring>
typename Recursion<Semiring>::AxisStep Recursion<Semiring>::laterAxis(const KinematicAxis &axis, Index number,
                                                                      Index inner, Index before, Index after,
                                                                      double transitionScale) const
{
    AxisStep step{axis.cells, inner, axis.cyclic, std::vector<std::vector<Shift>>(std::size_t(m_groupSize))};
    const std::vector<KinematicAxis::Move> moves = axis.moves(number);
    for (Index b = 0; b < before; ++b)
        for (const KinematicAxis::Move &move : moves)
            for (Index c = 0; c < after; ++c) {
                const auto plane = [&](Index rate) { return (b * axis.rateCount + rate) * after + c; };
                Shift shift{plane(move.fromRate), move.cells, weightOf<Semiring>(move.lnProbability * transitionScale)};
                if (move.cells != 0) {
                    const auto same = [&](const Shift &copy) {
                        return copy.from == shift.from && copy.cells == shift.cells;
                    };
                    const auto found = std::find_if(step.copies.begin(), step.copies.end(), same);
                    const Index copyNumber = m_groupSize + (found - step.copies.begin());
                    if (found == step.copies.end())
                        step.copies.push_back(shift);
                    shift = {copyNumber, 0, shift.weight};
                }
                step.shifts[std::size_t(plane(move.toRate))].push_back(shift);
            }
    return step;
}

/// Replaces runs of sources of equal weight, each two rates and a cell on from the one before, by maxima over two and
/// four of them. They may overlap: a maximum minds no repetition.
template <class Semiring>
void Recursion<Semiring>::prepareSlides()
{
    const Index rates = m_groups;
    AxisStep &first = m_phases.front().first;
    std::vector<Slide> wanted(std::size_t(2 * rates), {-1, 0, 0, 0, 0, 0});
    const auto want = [&](Index number, Index of, Index other, Index back, Index shift) {
        Slide &slide = wanted[std::size_t(number - rates)];
        slide = slide.number < 0
                    ? Slide{number, of, other, back, shift, shift}
                    : Slide{number, of, other, back, std::min(slide.smallest, shift), std::max(slide.largest, shift)};
    };
    const auto ofTwo = [&](Index rate, Index shift) {
        want(rates + rate, rate, rate + 2, 1, shift);
        return rates + rate;
    };
    const auto ofFour = [&](Index rate, Index shift) {
        ofTwo(rate, shift);
        ofTwo(rate + 4, shift + 2);
        want(2 * rates + rate, rates + rate, rates + rate + 4, 2, shift);
        return 2 * rates + rate;
    };
    std::vector<std::vector<Shift>> replaced = first.shifts;
    for (std::vector<Shift> &shifts : replaced) {
        const bool isUniform = std::all_of(shifts.begin(), shifts.end(),
                                           [&](const Shift &s) { return s.weight == shifts.front().weight; });
        if (shifts.size() < fewest || !isUniform)
            continue;
        const std::vector<Shift> all = std::exchange(shifts, {});
        std::vector<bool> used(all.size(), false);
        for (std::size_t start = 0; start < all.size(); ++start) {
            if (used[start])
                continue;
            std::vector<Shift> run{all[start]};
            for (std::size_t next = start + 1; next < all.size(); ++next)
                if (!used[next] && all[next].from == run.back().from + 2 && all[next].cells == run.back().cells + 1) {
                    run.push_back(all[next]);
                    used[next] = true;
                }
            const std::size_t length = run.size() >= 4 ? 4 : run.size() >= 2 ? 2 : 1;
            for (std::size_t at = 0; at < run.size(); at += length) {
                const Shift &begin = run[std::min(at, run.size() - length)];
                Index from = begin.from;
                if (length > 1)
                    from = length == 4 ? ofFour(begin.from, begin.cells) : ofTwo(begin.from, begin.cells);
                shifts.push_back({from, begin.cells, begin.weight});
            }
        }
    }
    // Each is made just before the first target that takes it, those it is made of before it.
    std::vector<bool> made(wanted.size(), false);
    for (std::size_t rate = 0; rate < replaced.size(); ++rate) {
        const auto make = [&](auto &&self, Index number) -> void {
            if (number < rates || made[std::size_t(number - rates)])
                return;
            const Slide &slide = wanted[std::size_t(number - rates)];
            self(self, slide.of);
            self(self, slide.other);
            made[std::size_t(number - rates)] = true;
            m_slides[rate].push_back(slide);
            m_largest.resize(wanted.size());
            m_largest[std::size_t(number - rates)] = slide.largest;
        };
        for (const Shift &shift : replaced[rate])
            make(make, shift.from);
    }
    if (std::none_of(m_slides.begin(), m_slides.end(),
                     [](const std::vector<Slide> &slides) { return !slides.empty(); }))
        return;
    for (std::size_t rate = 0; rate < replaced.size(); ++rate)
        for (const Shift &shift : first.shifts[rate])
            m_slideRing = std::max(m_slideRing, 2 * std::abs(shift.from - Index(rate)) + 1);
    if (m_isSingle) // then all targets are finished together
        m_slideRing = rates;
    first.shifts = std::move(replaced);
}

template <class Semiring>
void Recursion<Semiring>::prepareTiles()
{
    const Index fitting = std::clamp(tileBytes / (2 * m_planeCount * Index(sizeof(Real))), fewestCells, tileCells);
    const bool isSingle = m_planeCount == m_groups && m_isSingle;
    // Shared maxima need more rows than the tile has: those of a short one would cost too much.
    const Index cells = isSingle ? longTileCells : m_slideRing > 0 ? tileCells : fitting;
    m_tileRows = std::clamp<Index>(cells / m_inner, 1, m_rows);
    // Whole vectors, if that can be had.
    for (Index rows = m_tileRows; rows > 0 && m_tileRows < m_rows; --rows)
        if (rows * m_inner % vectorCells == 0) {
            m_tileRows = rows;
            break;
        }
    // Of a wide law only those sources count that exist for some row of a tile.
    if (4 * m_reach > m_rows)
        m_tileRows = std::min<Index>(m_tileRows, 8);
    m_edgeRows = 2 * m_reach + 2 * m_tileRows >= m_rows ? m_rows : m_reach;
    const auto cut = [&](Index from, Index to) {
        for (; from < to; from += m_tileRows)
            m_tiles.push_back({from, std::min(m_tileRows, to - from)});
    };
    if (m_edgeRows == m_rows) {
        cut(0, m_rows);
    } else {
        cut(0, m_edgeRows);
        cut(m_edgeRows, m_rows - m_edgeRows);
        cut(m_rows - m_edgeRows, m_rows);
    }
    Index slideRows = 0;
    for (const std::vector<Slide> &slides : m_slides)
        for (const Slide &s : slides)
            slideRows = std::max(slideRows, s.largest - s.smallest);
    m_slotSize = (m_tileRows + slideRows) * m_inner;
    if (m_reach > 0) {
        const Index rows = m_edgeRows == m_rows ? m_rows + 2 * m_reach : 2 * (m_edgeRows + 2 * m_reach);
        m_margins.resize(std::size_t(m_planeCount * rows * m_inner));
    }
}

template <class Semiring>
void Recursion<Semiring>::prepareSlantedTiles() requires std::same_as<Semiring, MaxPlus<float>>
{
    if constexpr (std::same_as<Semiring, MaxPlus<float>>) { // clang 14 makes it for the others as well
        if (m_isCyclic || m_slideRing > 0 || !m_departures.empty() || !m_rateDepartures.empty() || !m_matrices.empty())
            return;
        std::vector<SlantedTiles::Targets> phases;
        for (const Phase &phase : m_phases) {
            SlantedTiles::Targets &targets = phases.emplace_back(std::size_t(m_groups));
            for (Index rate = 0; rate < m_groups; ++rate) {
                std::vector<SlantedTiles::Source> &sources = targets[std::size_t(rate)];
                if (phase.first.shifts.empty())
                    sources.push_back({rate, 0, 0.0f});
                else
                    for (const Shift &shift : phase.first.shifts[std::size_t(rate)])
                        sources.push_back({shift.from, shift.cells, shift.weight});
            }
        }
        if (SlantedTiles tiles(m_rows, std::move(phases)); tiles.areWorthwhile())
            m_slanted = std::move(tiles);
    }
}

template <class Semiring>
void Recursion<Semiring>::preparePlaces(const StateSpace &space, double transitionScale)
{
    const auto weight = [&](double ln) {
        return static_cast<Real>(Semiring::logarithmic ? ln * transitionScale : std::exp(ln * transitionScale));
    };
    std::vector<double> lnDepartures(std::size_t(space.cellCount()), 0.0);
    bool departs = false;
    Index inner = space.cellCount();
    Index after = m_planeCount;
    for (const KinematicAxis &axis : space.axes()) {
        inner /= axis.cells;
        after /= axis.rateCount;
        if (!axis.transition.empty()) {
            MatrixStep step{axis.cells, inner, {}};
            for (const double p : axis.transition)
                step.weights.push_back(p > 0.0 ? weight(std::log(p)) : nothing<Semiring>());
            m_matrices.push_back(std::move(step));
        }
        if (!axis.renormalised)
            continue;
        if (axis.step.empty()) {
            RateDepartures d{axis.cells, inner, axis.rateCount, after, axis.edgeCells(), {}};
            for (Index number = 0; number < axis.phaseCount(); ++number) {
                auto &phase = d.phases.emplace_back();
                for (int rate = 0; rate < axis.rateCount; ++rate)
                    for (Index place = 0; place < d.places(); ++place) {
                        const Index cell = d.cellOf(place);
                        const int other = axis.rateGoingOn(cell, rate, number);
                        phase.weights.push_back(weight(other == rate ? axis.lnDeparture(cell, rate, number) : 0.0));
                        if (other != rate)
                            phase.turns.push_back({cell, d.cellsOf(place), rate, other});
                    }
            }
            m_rateDepartures.push_back(std::move(d));
            continue;
        }
        departs = true;
        std::vector<double> ln;
        for (Index cell = 0; cell < axis.cells; ++cell)
            ln.push_back(axis.lnDeparture(cell));
        for (Index cell = 0; cell < space.cellCount(); ++cell)
            lnDepartures[std::size_t(cell)] += ln[std::size_t(cell / inner % axis.cells)];
    }
    if (departs)
        for (const double ln : lnDepartures)
            m_departures.push_back(weight(ln));
}

template <class Semiring>
std::span<const typename Semiring::Real> Recursion<Semiring>::prepare(std::span<const Real> scores, Index step)
{
    if (m_departures.empty() && m_rateDepartures.empty() && m_matrices.empty())
        return scores;
    m_prepared.assign(scores.begin(), scores.end());
    if (!m_departures.empty())
        for (auto plane = m_prepared.begin(); plane != m_prepared.end(); plane += m_planeSize)
            depart<Semiring>(&*plane, m_departures.data(), m_planeSize);
    for (const RateDepartures &departures : m_rateDepartures)
        apply(departures, step, m_prepared);
    m_multiplied.resize(m_matrices.empty() ? 0 : scores.size());
    for (const MatrixStep &matrix : m_matrices) {
        apply(matrix, m_prepared, m_multiplied);
        std::swap(m_prepared, m_multiplied);
    }
    return m_prepared;
}

template <class Semiring>
void Recursion<Semiring>::apply(const MatrixStep &step, std::span<const Real> from, std::span<Real> to) const
{
    const Index block = step.cells * step.inner;
    std::vector<ShiftedPlane<Real>> sources(std::size_t(step.cells));
    for (Index first = 0; first < std::ssize(from); first += block)
        for (Index row = 0; row < step.cells; ++row) {
            for (Index source = 0; source < step.cells; ++source)
                sources[std::size_t(source)] = {from.data() + first + source * step.inner,
                                                step.weights[std::size_t(source * step.cells + row)]};
            joinSources<Semiring>(to.data() + first + row * step.inner, step.inner, sources);
        }
}

template <class Semiring>
void Recursion<Semiring>::apply(const RateDepartures &d, Index step, std::span<Real> scores) const
{
    const auto &phase = d.phases[std::size_t(step % std::ssize(d.phases))];
    const Index block = d.cells * d.inner;
    const auto forRuns = [&](Index rate, Index cell, auto &&visit) { // of every plane of a rate, the values of a cell
        for (Index plane = rate * d.after; plane < m_planeCount; plane += d.rates * d.after)
            for (Index each = plane; each < plane + d.after; ++each)
                for (Index first = each * m_planeSize + cell * d.inner; first < (each + 1) * m_planeSize;
                     first += block)
                    visit(scores.data() + first);
    };
    for (const auto &turn : phase.turns)
        forRuns(turn.fromRate, turn.cell, [&](Real *from) {
            Real *to = from + (turn.toRate - turn.fromRate) * d.after * m_planeSize;
            for (Index i = 0; i < turn.count * d.inner; ++i) {
                to[i] = Semiring::logarithmic ? std::max(to[i], from[i]) : to[i] + from[i];
                from[i] = nothing<Semiring>();
            }
        });
    for (Index rate = 0; rate < d.rates; ++rate)
        for (Index place = 0; place < d.places(); ++place) {
            const Real weight = phase.weights[std::size_t(rate * d.places() + place)];
            if (weight == weightOf<Semiring>(0.0))
                continue;
            forRuns(rate, d.cellOf(place), [&](Real *run) {
                for (Index i = 0; i < d.cellsOf(place) * d.inner; ++i)
                    run[i] = Semiring::logarithmic ? run[i] + weight : run[i] * weight;
            });
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
        for (const Phase &phase : m_phases)
            for (const AxisStep &step : phase.later)
                copies = std::max(copies, step.copies.size());
        made->tile.resize(planes * size);
        made->otherTile.resize(planes * size);
        made->copies.resize(copies * size);
        made->lambda.resize(size);
        made->slides.resize(std::size_t(2 * m_slideRing * m_groupSize * m_slotSize));
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
    scores = prepare(scores, step);
    fillMargins(scores);
    Scratch &own = scratch(0);
    std::vector<Real> predicted(std::size_t(m_tileRows * m_inner));
    for (const TileRows &rows : m_tiles)
        goThroughTile(phaseOf(step), scores, rows, own, [&](Index firstPlane) {
            const std::span<Real> to = std::span(predicted).first(std::size_t(rows.count * m_inner));
            for (std::size_t k = 0; k + 1 < own.firstSource.size(); ++k) {
                joinSources<Semiring>(to.data(), std::ssize(to), own.sourcesOf(k));
                take(firstPlane + Index(k), rows.first * m_inner, to);
            }
        });
}

/// Rows beyond the ends of the first axis, and those near to them: rows -reach … edge+reach and the same at the other
/// end, or all.
template <class Semiring>
void Recursion<Semiring>::fillMargins(std::span<const Real> scores)
{
    if (m_reach == 0)
        return;
    const Index cells = m_rows;
    const Index inner = m_inner;
    Real *to = m_margins.data();
    const auto copyRows = [&](const Real *plane, Index from, Index end) {
        for (Index row = from; row < end;) {
            const bool isInside = row >= 0 && row < cells;
            const Index next = row < 0 ? std::min<Index>(0, end) : row < cells ? std::min(cells, end) : end;
            const Index wrapped = row < 0 ? row + cells : row - cells;
            const Index n = (next - row) * inner;
            if (isInside)
                std::copy_n(plane + row * inner, n, to);
            else if (m_isCyclic)
                std::copy_n(plane + wrapped * inner, n, to);
            else
                std::fill_n(to, n, nothing<Semiring>());
            to += n;
            row = next;
        }
    };
    for (Index number = 0; number < m_planeCount; ++number) {
        const Real *plane = scores.data() + number * m_planeSize;
        if (m_edgeRows == cells) {
            copyRows(plane, -m_reach, cells + m_reach);
        } else {
            copyRows(plane, -m_reach, m_edgeRows + m_reach);
            copyRows(plane, cells - m_edgeRows - m_reach, cells + m_reach);
        }
    }
}

/// Where a plane's rows from firstRow on lie, with `reach` more on either side of the tile.
template <class Semiring>
const typename Semiring::Real *Recursion<Semiring>::rowsOf(std::span<const Real> scores, Index plane,
                                                           Index firstRow) const
{
    const Index cells = m_rows;
    const bool isLow = firstRow < m_edgeRows;
    if (m_reach == 0 || (!isLow && firstRow < cells - m_edgeRows))
        return scores.data() + plane * m_planeSize + firstRow * m_inner;
    const bool isWhole = m_edgeRows == cells;
    const Index rows = m_edgeRows + 2 * m_reach;
    const Index block = isWhole || isLow ? 0 : rows;
    const Index begin = isWhole || isLow ? -m_reach : cells - m_edgeRows - m_reach;
    return m_margins.data() + (plane * (isWhole ? rows : 2 * rows) + block + firstRow - begin) * m_inner;
}

/// Where a maximum is kept: those of the same rates as many targets on as a law reaches take the place of those of
/// before.
template <class Semiring>
Index Recursion<Semiring>::slotOf(Index number, Index group) const
{
    const Index level = number / m_groups - 1; // over two, over four
    return (level * m_slideRing + number % m_groups % m_slideRing) * m_groupSize + group;
}

/// Makes one maximum for the rows of a tile.
template <class Semiring>
void Recursion<Semiring>::slide(std::span<const Real> scores, const Slide &slide, Index group, TileRows rows,
                                Scratch &own) const
{
    if constexpr (Semiring::logarithmic) {
        const Index inner = m_inner;
        const auto place = [&](Index number) { return own.slides.data() + slotOf(number, group) * m_slotSize; };
        const Index firstRow = -slide.largest; // relative to the tile
        const auto from = [&](Index number, Index back) -> const Real * {
            if (number < m_groups)
                return rowsOf(scores, number * m_groupSize + group, rows.first) + (firstRow - back) * inner;
            return place(number) + (firstRow - back + m_largest[std::size_t(number - m_groups)]) * inner;
        };
        const Index count = rows.count + slide.largest - slide.smallest;
        maxOfTwo(place(slide.number), from(slide.of, 0), from(slide.other, slide.back), count * inner);
    }
}

/// The sources of one target plane of the first axis, for the rows of a tile.
template <class Semiring>
void Recursion<Semiring>::listFirst(const AxisStep &first, std::span<const Real> scores, Index rate, Index group,
                                    TileRows rows, Scratch &own) const
{
    const Index inner = m_inner;
    if (first.shifts.empty()) {
        own.sources.push_back({rowsOf(scores, rate * m_groupSize + group, rows.first), weightOf<Semiring>(0.0)});
        return;
    }
    for (const Shift &shift : first.shifts[std::size_t(rate)]) {
        if (shift.from >= m_groups) {
            const auto number = std::size_t(shift.from - m_groups);
            const Real *maxima = own.slides.data() + slotOf(shift.from, group) * m_slotSize;
            own.sources.push_back({maxima + (m_largest[number] - shift.cells) * inner, shift.weight});
        } else if (m_isCyclic || (rows.first - shift.cells < m_rows && rows.first + rows.count - shift.cells > 0)) {
            own.sources.push_back(
                {rowsOf(scores, shift.from * m_groupSize + group, rows.first) - shift.cells * inner, shift.weight});
        }
    }
}

/// Shifted copies of the planes a later axis starts from; what would come from beyond the axis's ends is neutral, or
/// wrapped round.
template <class Semiring>
void Recursion<Semiring>::makeCopies(const AxisStep &step, Index size, Scratch &own) const
{
    const Index period = step.cells * step.inner;
    for (std::size_t number = 0; number < step.copies.size(); ++number) {
        const Shift &copy = step.copies[number];
        const Real *from = own.planes[std::size_t(copy.from)];
        Real *to = own.copies.data() + Index(number) * size;
        const Index cells = std::clamp(copy.cells, -step.cells, step.cells);
        const Index by = cells * step.inner;
        // As if all blocks were one; then what that got wrong at their ends.
        if (by > 0)
            std::copy_n(from, size - by, to + by);
        else
            std::copy_n(from - by, size + by, to);
        const Index wrong = std::abs(by);
        const Index first = by > 0 ? 0 : period - wrong;
        for (Index block = first; block < size; block += period) {
            if (step.cyclic) {
                for (Index i = 0; i < wrong; ++i)
                    to[block + i] = from[block + i - by + (by > 0 ? period : -period)];
            } else {
                std::fill_n(to + block, wrong, nothing<Semiring>());
            }
        }
        own.planes.push_back(to);
    }
}

/// All axes' steps for the rows of a tile. `finish(plane)` is called with the first of the target planes whose sources
/// have been listed.
template <class Semiring>
template <class Finish>
void Recursion<Semiring>::goThroughTile(const Phase &phase, std::span<const Real> scores, TileRows rows, Scratch &own,
                                        Finish finish) const
{
    const Index bytes = rows.count * m_inner * Index(sizeof(Real));
    own.clearSources();
    for (Index rate = 0; rate < m_groups; ++rate) {
        for (const Slide &s : m_slides[std::size_t(rate)])
            for (Index group = 0; group < m_groupSize; ++group)
                slide(scores, s, group, rows, own);
        if (!phase.later.empty())
            own.clearSources();
        for (Index group = 0; group < m_groupSize; ++group) {
            if (const Index ahead = rows.first + rows.count; ahead + rows.count <= m_rows)
                fetch<false>(scores.data() + (rate * m_groupSize + group) * m_planeSize + ahead * m_inner, bytes);
            listFirst(phase.first, scores, rate, group, rows, own);
            own.endTarget();
        }
        if (phase.later.empty())
            continue;
        const Index size = rows.count * m_inner;
        for (const AxisStep &step : phase.later) {
            joinListed(phase.later.size() == 1, size, own);
            makeCopies(step, size, own);
            own.clearSources();
            for (const std::vector<Shift> &shifts : step.shifts) {
                for (const Shift &shift : shifts)
                    own.sources.push_back({own.planes[std::size_t(shift.from)], shift.weight});
                own.endTarget();
            }
        }
        finish(rate * m_groupSize);
    }
    if (phase.later.empty())
        finish(0);
}

/// Joins the sources of each target that has been listed to a plane; one that would be but a copy is the plane itself.
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
Continued Recursion<Semiring>::advance(std::span<const float> scores, std::span<float> next, const Frames &frames,
                                       const Likelihood &likelihood,
                                       const FrameJoin &join) requires std::same_as<Semiring, MaxPlus<float>>
{
    if constexpr (std::same_as<Semiring, MaxPlus<float>>) { // clang 14 makes it for the others as well
        RunContext context;
        const Index work = std::ssize(frames.y) * m_planeCount;
        context.threads = int(std::clamp<Index>(work / worthAThread, 1, m_threads));
        if (std::ssize(frames.y) > m_planeSize)
            return m_slanted->advance(scores, next, frames.y, frames.statistic, frames.firstStep, likelihood, join,
                                      context);
        return advanceOne(scores, next, frames, likelihood, join, context);
    } else {
        return {};
    }
}

template <class Semiring>
Continued Recursion<Semiring>::advanceOne(std::span<const float> scores, std::span<float> next, const Frames &frames,
                                          const Likelihood &likelihood, const FrameJoin &join,
                                          const RunContext &context) requires std::same_as<Semiring, MaxPlus<float>>
{
    if constexpr (std::same_as<Semiring, MaxPlus<float>>) { // clang 14 makes it for the others as well
        scores = prepare(scores, frames.firstStep);
        fillMargins(scores);
        m_tileContinued.assign(m_tiles.size(), {});
        const Phase &phase = phaseOf(frames.firstStep);
        const auto doTile = [&](Index number, Scratch &own) {
            const TileRows rows = m_tiles[std::size_t(number)];
            const Index firstCell = rows.first * m_inner;
            const Index n = rows.count * m_inner;
            likelihood.apply(frames.y.subspan(std::size_t(firstCell), std::size_t(n)),
                             std::span(own.lambda).first(std::size_t(n)));
            Continued &continued = m_tileContinued[std::size_t(number)];
            goThroughTile(phase, scores, rows, own, [&](Index firstPlane) {
                own.targets.clear();
                for (std::size_t k = 0; k + 1 < own.firstSource.size(); ++k) {
                    float *const to = next.data() + (firstPlane + Index(k)) * m_planeSize;
                    own.targets.push_back({own.sourcesOf(k), to});
                    if (firstCell + 2 * n <= m_planeSize)
                        fetch<true>(to + firstCell + n, n * Index(sizeof(float)));
                }
                FrameJoin joined = join;
                joined.isFresh = firstPlane == 0;
                const Continued part = finishMax(own.targets, n, 0, firstCell, own.lambda.data(), joined,
                                                 frames.statistic.data() + firstCell);
                continued.count += part.count;
                continued.sum += part.sum;
            });
        };
        // A stretch of tiles for each thread: each fetches the next tile ahead.
        const Index count = std::ssize(m_tiles);
        scratch(std::size_t(context.threads) - 1);
        parallelFor(context.threads, context, "recursion", [&] {
            return [&](Index thread) {
                for (Index number = thread * count / context.threads; number < (thread + 1) * count / context.threads;
                     ++number)
                    doTile(number, *m_scratch[std::size_t(thread)]);
            };
        });
        Continued all;
        for (const Continued &part : m_tileContinued) { // in this order: a sum in floating point
            all.count += part.count;
            all.sum += part.sum;
        }
        return all;
    } else {
        return {};
    }
}

template class Recursion<MaxPlus<float>>;
template class Recursion<MaxPlus<double>>;
template class Recursion<SumProduct>;

} // namespace faintline
