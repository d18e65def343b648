#include "recursion/Departures.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    template <class Semiring>
    void depart(typename Semiring::Real *to, const typename Semiring::Real *departures, Index n)
    {
        if constexpr (Semiring::logarithmic)
            addEach(to, departures, n);
        else
            multiplyEach(to, departures, n);
    }

} // namespace

template <class Semiring>
Departures<Semiring>::Departures(const StateSpace &space, double transitionScale)
    : m_transitionScale(transitionScale), m_planeSize(space.cellCount()), m_planeCount(space.planeCount())
{
    std::vector<double> lnDepartures(std::size_t(space.cellCount()), 0.0);
    bool departs = false;
    Index inner = space.cellCount();
    Index after = m_planeCount;
    for (const KinematicAxis &axis : space.axes()) {
        inner /= axis.cells;
        after /= axis.rateCount;
        if (!axis.transition.empty()) {
            Matrix matrix{axis.cells, inner, {}};
            for (const double p : axis.transition)
                matrix.weights.push_back(p > 0.0 ? weight(std::log(p)) : neutral<Semiring>());
            m_matrices.push_back(std::move(matrix));
        }
        if (!axis.renormalised)
            continue;
        if (axis.step.empty()) {
            addRates(axis, inner, after);
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
            m_ofCells.push_back(weight(ln));
}

template <class Semiring>
typename Semiring::Real Departures<Semiring>::weight(double ln) const
{
    return weightOf<Semiring>(ln * m_transitionScale);
}

template <class Semiring>
void Departures<Semiring>::addRates(const KinematicAxis &axis, Index inner, Index after)
{
    OfRates d{axis.cells, inner, axis.rateCount, after, axis.edgeCells(), {}};
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
    m_ofRates.push_back(std::move(d));
}

template <class Semiring>
std::span<const typename Semiring::Real> Departures<Semiring>::apply(std::span<const Real> scores, Index step)
{
    if (areNone())
        return scores;
    m_scores.assign(scores.begin(), scores.end());
    if (!m_ofCells.empty())
        for (auto plane = m_scores.begin(); plane != m_scores.end(); plane += m_planeSize)
            depart<Semiring>(&*plane, m_ofCells.data(), m_planeSize);
    for (const OfRates &departures : m_ofRates)
        apply(departures, step, m_scores);
    m_multiplied.resize(m_matrices.empty() ? 0 : scores.size());
    for (const Matrix &matrix : m_matrices) {
        apply(matrix, m_scores, m_multiplied);
        std::swap(m_scores, m_multiplied);
    }
    return m_scores;
}

template <class Semiring>
void Departures<Semiring>::apply(const Matrix &step, std::span<const Real> from, std::span<Real> to) const
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
void Departures<Semiring>::apply(const OfRates &d, Index step, std::span<Real> scores) const
{
    const auto &phase = d.phases[std::size_t(step % std::ssize(d.phases))];
    const Index block = d.cells * d.inner;
    const auto forRuns = [&](Index rate, Index cell, auto &&visit) { // the values of a cell in each plane of a rate
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
                from[i] = neutral<Semiring>();
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

template class Departures<MaxPlus<float>>;
template class Departures<MaxPlus<double>>;
template class Departures<SumProduct>;

} // namespace faintline
