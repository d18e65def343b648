#include "detect/Recursion.h"

#include "base/multiversion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace faintline {

namespace {

    constexpr Index tileCells = 4096;  ///< such a piece of every source plane of a target fits into the second-level cache
    constexpr Index lanes = 64;        ///< values kept in registers while all sources are joined to them

    struct MaxJoin {
        template <class Real>
        Real first(Real value, Real weight) const
        {
            return value + weight;
        }
        template <class Real>
        Real next(Real best, Real value, Real weight) const
        {
            const Real candidate = value + weight;
            return candidate > best ? candidate : best;
        }
        template <class Real>
        Real last(Real best, Real) const
        {
            return best;
        }
    };

    /// Where all weights are the same: max(a + w, b + w) = max(a, b) + w to the last bit, for rounding is monotone.
    struct EqualMaxJoin {
        template <class Real>
        Real first(Real value, Real) const
        {
            return value;
        }
        template <class Real>
        Real next(Real best, Real value, Real) const
        {
            return value > best ? value : best;
        }
        template <class Real>
        Real last(Real best, Real weight) const
        {
            return best + weight;
        }
    };

    struct SumJoin {
        double first(double value, double weight) const { return value * weight; }
        double next(double sum, double value, double weight) const { return sum + value * weight; }
        double last(double sum, double) const { return sum; }
    };

    /// to[i] = ⊕_k from_k[i] ⊗ weight_k, the sources in their order.
    template <class Real, class Join>
    [[gnu::always_inline]] inline void joinAll(Real *to, Index n, const ShiftedPlane<Real> *sources, std::size_t count, Join join)
    {
        Index i = 0;
        for (; i + lanes <= n; i += lanes) {
            Real sum[lanes];
            for (Index lane = 0; lane < lanes; ++lane)
                sum[lane] = join.first(sources[0].from[i + lane], sources[0].weight);
            for (std::size_t k = 1; k < count; ++k) {
                const Real *from = sources[k].from + i;
                const Real weight = sources[k].weight;
                for (Index lane = 0; lane < lanes; ++lane)
                    sum[lane] = join.next(sum[lane], from[lane], weight);
            }
            for (Index lane = 0; lane < lanes; ++lane)
                to[i + lane] = join.last(sum[lane], sources[0].weight);
        }
        for (; i < n; ++i) {
            Real sum = join.first(sources[0].from[i], sources[0].weight);
            for (std::size_t k = 1; k < count; ++k)
                sum = join.next(sum, sources[k].from[i], sources[k].weight);
            to[i] = join.last(sum, sources[0].weight);
        }
    }

    template <class Real>
    bool haveEqualWeights(const ShiftedPlane<Real> *sources, std::size_t count)
    {
        return std::all_of(sources, sources + count, [&](const ShiftedPlane<Real> &s) { return s.weight == sources[0].weight; });
    }

    FAINTLINE_MULTIVERSION
    void joinMax(float *to, Index n, const ShiftedPlane<float> *sources, std::size_t count)
    {
        joinAll(to, n, sources, count, MaxJoin());
    }

    FAINTLINE_MULTIVERSION
    void joinEqualMax(float *to, Index n, const ShiftedPlane<float> *sources, std::size_t count)
    {
        joinAll(to, n, sources, count, EqualMaxJoin());
    }

    void joinEqualMax(double *to, Index n, const ShiftedPlane<double> *sources, std::size_t count)
    {
        joinAll(to, n, sources, count, EqualMaxJoin());
    }

    FAINTLINE_MULTIVERSION
    void joinMax(double *to, Index n, const ShiftedPlane<double> *sources, std::size_t count)
    {
        joinAll(to, n, sources, count, MaxJoin());
    }

    FAINTLINE_MULTIVERSION
    void addEach(float *to, const float *more, Index n)
    {
        for (Index i = 0; i < n; ++i)
            to[i] += more[i];
    }

    FAINTLINE_MULTIVERSION
    void addEach(double *to, const double *more, Index n)
    {
        for (Index i = 0; i < n; ++i)
            to[i] += more[i];
    }

    FAINTLINE_MULTIVERSION
    void multiplyEach(double *to, const double *factors, Index n)
    {
        for (Index i = 0; i < n; ++i)
            to[i] *= factors[i];
    }

    template <class Semiring>
    void depart(typename Semiring::Real *to, const typename Semiring::Real *departures, Index n)
    {
        if constexpr (Semiring::logarithmic)
            addEach(to, departures, n);
        else
            multiplyEach(to, departures, n);
    }

    FAINTLINE_MULTIVERSION
    void joinSum(double *to, Index n, const ShiftedPlane<double> *sources, std::size_t count)
    {
        joinAll(to, n, sources, count, SumJoin());
    }

    template <class Semiring>
    constexpr typename Semiring::Real nothing()
    {
        if constexpr (Semiring::logarithmic)
            return -std::numeric_limits<typename Semiring::Real>::infinity();
        else
            return 0;
    }

    template <class Semiring>
    void joinSources(typename Semiring::Real *to, Index n, const std::vector<ShiftedPlane<typename Semiring::Real>> &sources)
    {
        if (sources.empty()) {
            std::fill_n(to, n, nothing<Semiring>());
        } else if constexpr (Semiring::logarithmic) {
            if (haveEqualWeights(sources.data(), sources.size()))
                joinEqualMax(to, n, sources.data(), sources.size());
            else
                joinMax(to, n, sources.data(), sources.size());
        } else {
            joinSum(to, n, sources.data(), sources.size());
        }
    }

    /// An axis that never moves and loses no probability needs no step of its own.
    bool isIdentity(const std::vector<KinematicAxis::Move> &moves)
    {
        return std::all_of(moves.begin(), moves.end(), [](const KinematicAxis::Move &m) {
            return m.fromRate == m.toRate && m.cells == 0 && m.lnProbability == 0.0;
        });
    }

    /// Rows first … second-1 are those in which no shift reaches beyond the axis's ends.
    template <class Shifts>
    std::pair<Index, Index> interior(const Shifts &shifts, Index cells)
    {
        Index low = 0;
        Index high = cells;
        for (const auto &shift : shifts) {
            low = std::max(low, shift.cells);
            high = std::min(high, cells + shift.cells);
        }
        return low < high ? std::pair{low, high} : std::pair{cells, cells};
    }

    /// The row a shift takes its value from, or -1 where there is none.
    Index sourceRow(Index row, Index shift, Index cells, bool cyclic)
    {
        const Index source = row - shift;
        if (source >= 0 && source < cells)
            return source;
        if (!cyclic)
            return -1;
        const Index rest = source % cells;
        return rest < 0 ? rest + cells : rest;
    }

} // namespace

template <class Semiring>
Recursion<Semiring>::Recursion(const StateSpace &space, double transitionScale)
    : m_planeSize(space.cellCount()), m_planeCount(space.planeCount()), m_groups(space.axes().front().rateCount),
      m_groupSize(m_planeCount / m_groups)
{
    Index inner = space.cellCount();
    Index before = 1; // rate combinations within a group: of the later axes before this one …
    Index after = m_groupSize; // … and after it
    for (std::size_t axis = 0; axis < space.axes().size(); ++axis) {
        const KinematicAxis &a = space.axes()[axis];
        inner /= a.cells;
        if (axis > 0)
            after /= a.rateCount;
        AxisStep step{a.cells, inner, a.cyclic, {}};
        const std::vector<KinematicAxis::Move> moves = a.moves();
        if (!isIdentity(moves)) {
            std::vector<std::vector<Shift>> byRate(static_cast<std::size_t>(a.rateCount));
            for (const KinematicAxis::Move &move : moves) {
                const double ln = move.lnProbability * transitionScale;
                byRate[static_cast<std::size_t>(move.toRate)].push_back(
                    {move.fromRate, move.cells, static_cast<Real>(Semiring::logarithmic ? ln : std::exp(ln))});
            }
            if (axis == 0)
                step.shifts = std::move(byRate);
            else
                for (Index b = 0; b < before; ++b)
                    for (Index toRate = 0; toRate < a.rateCount; ++toRate)
                        for (Index c = 0; c < after; ++c) {
                            std::vector<Shift> shifts = byRate[static_cast<std::size_t>(toRate)];
                            for (Shift &shift : shifts)
                                shift.fromPlane = (b * a.rateCount + shift.fromPlane) * after + c;
                            step.shifts.push_back(std::move(shifts));
                        }
        }
        if (axis == 0)
            m_first = std::move(step);
        else if (!step.shifts.empty())
            m_later.push_back(std::move(step));
        if (axis > 0)
            before *= a.rateCount;
    }
    m_tileRows = std::clamp<Index>(tileCells / m_first.inner, 1, m_first.cells);
    const auto tileSize = static_cast<std::size_t>(m_groupSize * m_tileRows * m_first.inner);
    m_tile.resize(tileSize);
    m_otherTile.resize(m_later.empty() ? 0 : tileSize);
    preparePlaces(space, transitionScale);
}

template <class Semiring>
void Recursion<Semiring>::preparePlaces(const StateSpace &space, double transitionScale)
{
    const auto weight = [&](double ln) {
        return static_cast<Real>(Semiring::logarithmic ? ln * transitionScale : std::exp(ln * transitionScale));
    };
    std::vector<double> lnDepartures(static_cast<std::size_t>(space.cellCount()), 0.0);
    bool departs = false;
    Index inner = space.cellCount();
    for (const KinematicAxis &axis : space.axes()) {
        inner /= axis.cells;
        if (!axis.transition.empty()) {
            MatrixStep step{axis.cells, inner, {}};
            for (const double p : axis.transition)
                step.weights.push_back(p > 0.0 ? weight(std::log(p)) : nothing<Semiring>());
            m_matrices.push_back(std::move(step));
        }
        if (!axis.renormalised)
            continue;
        departs = true;
        std::vector<double> ln;
        for (Index cell = 0; cell < axis.cells; ++cell)
            ln.push_back(axis.lnDeparture(cell));
        for (Index cell = 0; cell < space.cellCount(); ++cell)
            lnDepartures[static_cast<std::size_t>(cell)] += ln[static_cast<std::size_t>(cell / inner % axis.cells)];
    }
    if (departs)
        for (const double ln : lnDepartures)
            m_departures.push_back(weight(ln));
}

template <class Semiring>
std::span<const typename Semiring::Real> Recursion<Semiring>::prepare(std::span<const Real> scores)
{
    if (m_departures.empty() && m_matrices.empty())
        return scores;
    m_prepared.assign(scores.begin(), scores.end());
    if (!m_departures.empty())
        for (auto plane = m_prepared.begin(); plane != m_prepared.end(); plane += m_planeSize)
            depart<Semiring>(&*plane, m_departures.data(), m_planeSize);
    m_multiplied.resize(m_matrices.empty() ? 0 : scores.size());
    for (const MatrixStep &step : m_matrices) {
        apply(step, m_prepared, m_multiplied);
        std::swap(m_prepared, m_multiplied);
    }
    return m_prepared;
}

template <class Semiring>
void Recursion<Semiring>::apply(const MatrixStep &step, std::span<const Real> from, std::span<Real> to) const
{
    const Index block = step.cells * step.inner;
    std::vector<ShiftedPlane<Real>> sources(static_cast<std::size_t>(step.cells));
    for (Index first = 0; first < std::ssize(from); first += block)
        for (Index row = 0; row < step.cells; ++row) {
            for (Index source = 0; source < step.cells; ++source)
                sources[static_cast<std::size_t>(source)] = {from.data() + first + source * step.inner,
                                                             step.weights[static_cast<std::size_t>(source * step.cells + row)]};
            joinSources<Semiring>(to.data() + first + row * step.inner, step.inner, sources);
        }
}

template <class Semiring>
std::span<typename Semiring::Real> Recursion<Semiring>::predict(std::span<const Real> scores)
{
    m_result.resize(static_cast<std::size_t>(m_planeSize * m_planeCount));
    predict(scores, [this](Index plane, Index firstCell, std::span<const Real> predicted) {
        std::copy(predicted.begin(), predicted.end(), m_result.begin() + plane * m_planeSize + firstCell);
    });
    return m_result;
}

template <class Semiring>
void Recursion<Semiring>::predict(std::span<const Real> scores, const Tile &take)
{
    scores = prepare(scores);
    for (Index firstRow = 0; firstRow < m_first.cells; firstRow += m_tileRows) {
        const Index rows = std::min(m_tileRows, m_first.cells - firstRow);
        const Index size = rows * m_first.inner;
        for (Index rate = 0; rate < m_groups; ++rate) {
            firstAxis(scores.data(), rate, firstRow, rows, m_tile.data());
            for (const AxisStep &step : m_later) {
                laterAxis(step, m_tile.data(), size, m_otherTile.data());
                std::swap(m_tile, m_otherTile);
            }
            for (Index plane = 0; plane < m_groupSize; ++plane)
                take(rate * m_groupSize + plane, firstRow * m_first.inner,
                     std::span<const Real>(m_tile).subspan(static_cast<std::size_t>(plane * size), static_cast<std::size_t>(size)));
        }
    }
}

template <class Semiring>
void Recursion<Semiring>::firstAxis(const Real *scores, Index targetRate, Index firstRow, Index rows, Real *to)
{
    const Index inner = m_first.inner;
    const Index size = rows * inner;
    for (Index plane = 0; plane < m_groupSize; ++plane, to += size) {
        const auto from = [&](Index rate, Index row) { return scores + (rate * m_groupSize + plane) * m_planeSize + row * inner; };
        if (m_first.shifts.empty()) {
            std::copy_n(from(targetRate, firstRow), size, to);
            continue;
        }
        const std::vector<Shift> &shifts = m_first.shifts[static_cast<std::size_t>(targetRate)];
        const auto [low, high] = interior(shifts, m_first.cells);
        const Index inside = std::clamp(low, firstRow, firstRow + rows);
        const Index outside = std::clamp(high, inside, firstRow + rows);
        if (inside < outside) {
            m_sources.clear();
            for (const Shift &shift : shifts)
                m_sources.push_back({from(shift.fromPlane, inside - shift.cells), shift.weight});
            joinSources<Semiring>(to + (inside - firstRow) * inner, (outside - inside) * inner, m_sources);
        }
        for (Index row = firstRow; row < firstRow + rows; ++row) {
            if (row == inside && inside < outside)
                row = outside;
            if (row == firstRow + rows)
                break;
            m_sources.clear();
            for (const Shift &shift : shifts)
                if (const Index source = sourceRow(row, shift.cells, m_first.cells, m_first.cyclic); source >= 0)
                    m_sources.push_back({from(shift.fromPlane, source), shift.weight});
            joinSources<Semiring>(to + (row - firstRow) * inner, inner, m_sources);
        }
    }
}

template <class Semiring>
void Recursion<Semiring>::laterAxis(const AxisStep &step, const Real *from, Index size, Real *to)
{
    for (const std::vector<Shift> &shifts : step.shifts) {
        const auto [low, high] = interior(shifts, step.cells);
        // In one sweep over all rows, as if they were one long row; what that gets wrong at their ends is put right afterwards.
        const Index begin = low * step.inner;
        const Index end = size - (step.cells - high) * step.inner;
        if (low < high) {
            m_sources.clear();
            for (const Shift &shift : shifts)
                m_sources.push_back({from + shift.fromPlane * size + begin - shift.cells * step.inner, shift.weight});
            joinSources<Semiring>(to + begin, end - begin, m_sources);
        }
        for (Index row = 0; row < step.cells; ++row) {
            if (row == low)
                row = high;
            if (row < step.cells)
                laterEdge(step, shifts, row, from, size, to);
        }
        to += size;
    }
}

template <class Semiring>
void Recursion<Semiring>::laterEdge(const AxisStep &step, const std::vector<Shift> &shifts, Index row, const Real *from, Index size,
                                    Real *to)
{
    m_sources.clear();
    for (const Shift &shift : shifts)
        if (const Index source = sourceRow(row, shift.cells, step.cells, step.cyclic); source >= 0)
            m_sources.push_back({from + shift.fromPlane * size + source * step.inner, shift.weight});
    const Index period = step.cells * step.inner;
    for (Index block = 0; block < size; block += period) {
        if (step.inner == 1) { // a few cells at a time: not worth a call
            Real sum = nothing<Semiring>();
            for (const ShiftedPlane<Real> &source : m_sources) {
                if constexpr (Semiring::logarithmic)
                    sum = MaxJoin().next(sum, source.from[block], source.weight);
                else
                    sum = SumJoin().next(sum, source.from[block], source.weight);
            }
            to[block + row] = sum;
        } else {
            joinSources<Semiring>(to + block + row * step.inner, step.inner, m_sources);
            for (ShiftedPlane<Real> &source : m_sources)
                source.from += period;
        }
    }
}

template class Recursion<MaxPlus<float>>;
template class Recursion<MaxPlus<double>>;
template class Recursion<SumProduct>;

} // namespace faintline
