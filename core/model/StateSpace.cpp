#include "model/StateSpace.h"

#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace faintline {

StateSpace::StateSpace(std::vector<KinematicAxis> axes) : m_axes(std::move(axes)), m_cellCount(1), m_planeCount(1)
{
    if (m_axes.empty())
        throw Error("model.axes", "must hold at least one axis");
    for (std::size_t i = 0; i < m_axes.size(); ++i) {
        m_axes[i].check("model.axes[" + std::to_string(i) + "]");
        m_moves.emplace_back();
        for (Index phase = 0; phase < m_axes[i].phaseCount(); ++phase)
            m_moves.back().push_back(m_axes[i].moves(phase));
        const double states = double(stateCount()) * double(m_axes[i].cells) * m_axes[i].rateCount;
        if (states > 0x1p31) // before the product can overflow
            throw Error("model.axes", "give more than 2³¹ states");
        m_cellCount *= m_axes[i].cells;
        m_planeCount *= m_axes[i].rateCount;
    }
}

StateSpace::Coordinates StateSpace::coordinates(Index state) const
{
    Coordinates result;
    result.rates.resize(m_axes.size());
    result.cells.resize(m_axes.size());
    Index cell = cellOf(state);
    Index plane = planeOf(state);
    for (std::size_t axis = m_axes.size(); axis-- > 0;) {
        result.cells[axis] = cell % m_axes[axis].cells;
        cell /= m_axes[axis].cells;
        result.rates[axis] = int(plane % m_axes[axis].rateCount);
        plane /= m_axes[axis].rateCount;
    }
    return result;
}

Index StateSpace::state(const Coordinates &c) const
{
    Index plane = 0;
    Index cell = 0;
    for (std::size_t axis = 0; axis < m_axes.size(); ++axis) {
        plane = plane * m_axes[axis].rateCount + c.rates[axis];
        cell = cell * m_axes[axis].cells + c.cells[axis];
    }
    return plane * m_cellCount + cell;
}

Index StateSpace::phaseCount() const
{
    Index phases = 1;
    for (const KinematicAxis &axis : m_axes)
        phases = std::lcm(phases, axis.phaseCount());
    return phases;
}

std::vector<double> StateSpace::ratesOfPlane(Index plane) const
{
    std::vector<double> rates(m_axes.size());
    for (std::size_t axis = m_axes.size(); axis-- > 0;) {
        rates[axis] = m_axes[axis].rate(plane % m_axes[axis].rateCount);
        plane /= m_axes[axis].rateCount;
    }
    return rates;
}

std::vector<StateSpace::Predecessor> StateSpace::predecessors(Index target, Index step) const
{
    const Coordinates to = coordinates(target);
    std::vector<Predecessor> result;
    Coordinates from = to;
    const auto descend = [&](auto &&self, std::size_t axis, double lnProbability) -> void {
        if (axis == m_axes.size()) {
            result.push_back({state(from), lnProbability});
            return;
        }
        const KinematicAxis &a = m_axes[axis];
        from.rates[axis] = to.rates[axis];
        for (Index cell = 0; !a.transition.empty() && cell < a.cells; ++cell) {
            from.cells[axis] = cell;
            if (const double p = a.transition[std::size_t(cell * a.cells + to.cells[axis])]; p > 0.0)
                self(self, axis + 1, lnProbability + std::log(p));
        }
        if (!a.transition.empty())
            return;
        for (const KinematicAxis::Move &move : m_moves[axis][std::size_t(step % a.phaseCount())]) {
            if (move.toRate != to.rates[axis])
                continue;
            Index cell = to.cells[axis] - move.cells;
            if (a.cyclic)
                cell = (cell % a.cells + a.cells) % a.cells;
            else if (cell < 0 || cell >= a.cells)
                continue;
            from.cells[axis] = cell;
            const double ln = lnProbability + move.lnProbability + a.lnDeparture(cell, move.fromRate, step);
            for (int rate = 0; rate < a.rateCount; ++rate)
                if (a.rateGoingOn(cell, rate, step) == move.fromRate) {
                    from.rates[axis] = rate;
                    self(self, axis + 1, ln);
                }
        }
    };
    descend(descend, 0, 0.0);
    std::stable_sort(result.begin(), result.end(),
                     [](const Predecessor &a, const Predecessor &b) { return a.state < b.state; });
    return result;
}

StateSpace StateSpace::window(const std::vector<Index> &cells) const
{
    std::vector<KinematicAxis> axes = m_axes;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        axes[i].cells = cells[i];
        axes[i].cyclic = false;
    }
    return StateSpace(std::move(axes));
}

} // namespace faintline
