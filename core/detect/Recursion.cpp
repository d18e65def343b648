#include "detect/Recursion.h"

#include "base/multiversion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    // The inner loops: `first` writes, `join` combines with what is there. Overloads pick the semiring.

    FAINTLINE_MULTIVERSION
    void firstMax(float *to, const float *from, Index n, float weight)
    {
        for (Index i = 0; i < n; ++i)
            to[i] = from[i] + weight;
    }

    FAINTLINE_MULTIVERSION
    void joinMax(float *to, const float *from, Index n, float weight)
    {
        for (Index i = 0; i < n; ++i) {
            const float candidate = from[i] + weight;
            to[i] = candidate > to[i] ? candidate : to[i];
        }
    }

    FAINTLINE_MULTIVERSION
    void firstMax(double *to, const double *from, Index n, double weight)
    {
        for (Index i = 0; i < n; ++i)
            to[i] = from[i] + weight;
    }

    FAINTLINE_MULTIVERSION
    void joinMax(double *to, const double *from, Index n, double weight)
    {
        for (Index i = 0; i < n; ++i) {
            const double candidate = from[i] + weight;
            to[i] = candidate > to[i] ? candidate : to[i];
        }
    }

    FAINTLINE_MULTIVERSION
    void firstSum(double *to, const double *from, Index n, double weight)
    {
        for (Index i = 0; i < n; ++i)
            to[i] = from[i] * weight;
    }

    FAINTLINE_MULTIVERSION
    void joinSum(double *to, const double *from, Index n, double weight)
    {
        for (Index i = 0; i < n; ++i)
            to[i] += from[i] * weight;
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

    template <class Semiring>
    void combine(bool isFirst, typename Semiring::Real *to, const typename Semiring::Real *from, Index n,
                 typename Semiring::Real weight)
    {
        if constexpr (Semiring::logarithmic)
            isFirst ? firstMax(to, from, n, weight) : joinMax(to, from, n, weight);
        else
            isFirst ? firstSum(to, from, n, weight) : joinSum(to, from, n, weight);
    }

    template <class Semiring>
    constexpr typename Semiring::Real nothing()
    {
        if constexpr (Semiring::logarithmic)
            return -std::numeric_limits<typename Semiring::Real>::infinity();
        else
            return 0;
    }

    /// Planes of the other axes stay as they are: a move of one axis is repeated for each of their rate combinations.
    struct PlaneLayout {
        Index outer; ///< combinations of the axes before
        Index inner; ///< combinations of the axes after
    };

    PlaneLayout planeLayout(const StateSpace &space, std::size_t axis)
    {
        PlaneLayout layout{1, 1};
        for (std::size_t a = 0; a < space.axes().size(); ++a) {
            if (a < axis)
                layout.outer *= space.axes()[a].rateCount;
            if (a > axis)
                layout.inner *= space.axes()[a].rateCount;
        }
        return layout;
    }

    /// An axis that never moves and loses no probability needs no step of its own.
    bool isIdentity(const std::vector<KinematicAxis::Move> &moves)
    {
        return std::all_of(moves.begin(), moves.end(), [](const KinematicAxis::Move &m) {
            return m.fromRate == m.toRate && m.cells == 0 && m.lnProbability == 0.0;
        });
    }

} // namespace

template <class Semiring>
Recursion<Semiring>::Recursion(const StateSpace &space, double transitionScale)
    : m_planeSize(space.cellCount()), m_result(static_cast<std::size_t>(space.stateCount()))
{
    Index inner = space.cellCount();
    for (std::size_t axis = 0; axis < space.axes().size(); ++axis) {
        const KinematicAxis &a = space.axes()[axis];
        inner /= a.cells;
        const std::vector<KinematicAxis::Move> moves = a.moves();
        if (isIdentity(moves))
            continue;
        AxisStep step{a.cells, inner, space.cellCount() / (a.cells * inner), a.cyclic, {}};
        const PlaneLayout planes = planeLayout(space, axis);
        for (Index before = 0; before < planes.outer; ++before)
            for (int toRate = 0; toRate < a.rateCount; ++toRate)
                for (Index after = 0; after < planes.inner; ++after) {
                    const auto plane = [&](int rate) { return (before * a.rateCount + rate) * planes.inner + after; };
                    const std::size_t shiftsBefore = step.shifts.size();
                    for (const KinematicAxis::Move &move : moves) {
                        if (move.toRate != toRate)
                            continue;
                        const double ln = move.lnProbability * transitionScale;
                        step.shifts.push_back({plane(move.fromRate), plane(toRate), move.cells,
                                               static_cast<Real>(Semiring::logarithmic ? ln : std::exp(ln))});
                    }
                    if (step.shifts.size() == shiftsBefore) // a rate that nothing leads to
                        step.shifts.push_back({plane(toRate), plane(toRate), 0, nothing<Semiring>()});
                }
        m_steps.push_back(std::move(step));
    }
    if (m_steps.size() > 1)
        m_scratch.resize(m_result.size());
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
    for (Index first = 0; first < std::ssize(from); first += block)
        for (Index row = 0; row < step.cells; ++row)
            for (Index source = 0; source < step.cells; ++source)
                combine<Semiring>(source == 0, to.data() + first + row * step.inner, from.data() + first + source * step.inner, step.inner,
                                  step.weights[static_cast<std::size_t>(source * step.cells + row)]);
}

template <class Semiring>
std::span<typename Semiring::Real> Recursion<Semiring>::predict(std::span<const Real> scores)
{
    scores = prepare(scores);
    if (m_steps.empty()) {
        std::copy(scores.begin(), scores.end(), m_result.begin());
        return m_result;
    }
    // The last step writes m_result; the ones before alternate so that none reads what it writes.
    std::span<const Real> from = scores;
    for (std::size_t i = 0; i < m_steps.size(); ++i) {
        const bool toResult = (m_steps.size() - 1 - i) % 2 == 0;
        std::vector<Real> &to = toResult ? m_result : m_scratch;
        apply(m_steps[i], from, to);
        from = to;
    }
    return m_result;
}

template <class Semiring>
void Recursion<Semiring>::apply(const AxisStep &step, std::span<const Real> from, std::span<Real> to) const
{
    Index plane = -1;
    for (const Shift &shift : step.shifts) {
        const bool isFirst = shift.toPlane != plane;
        plane = shift.toPlane;
        join(step, shift, isFirst, from.data() + shift.fromPlane * m_planeSize, to.data() + shift.toPlane * m_planeSize);
    }
}

template <class Semiring>
void Recursion<Semiring>::join(const AxisStep &step, const Shift &shift, bool isFirst, const Real *from, Real *to) const
{
    const Index row = step.cells * step.inner;
    const Index size = std::min<Index>(std::abs(shift.cells), step.cells) * step.inner; // cells that leave the row
    const bool up = shift.cells >= 0;
    for (Index block = 0; block < step.blocks; ++block, from += row, to += row) {
        combine<Semiring>(isFirst, to + (up ? size : 0), from + (up ? 0 : size), row - size, shift.weight);
        Real *edge = to + (up ? 0 : row - size);
        if (step.cyclic)
            combine<Semiring>(isFirst, edge, from + (up ? row - size : 0), size, shift.weight);
        else if (isFirst)
            std::fill_n(edge, size, nothing<Semiring>());
    }
}

template class Recursion<MaxPlus<float>>;
template class Recursion<MaxPlus<double>>;
template class Recursion<SumProduct>;

} // namespace faintline
