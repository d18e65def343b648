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
    for (const KinematicAxis &axis : m_axes) {
        axis.check("model.axes[" + std::to_string(m_moves.size()) + "]");
        m_moves.emplace_back();
        for (Index phase = 0; phase < axis.phaseCount(); ++phase)
            m_moves.back().push_back(axis.moves(phase));
        const double states = double(stateCount()) * double(axis.cells) * axis.rateCount;
        if (states > 0x1p31) // before the product can overflow
            throw Error("model.axes", "give more than 2³¹ states");
        m_cellCount *= axis.cells;
        m_planeCount *= axis.rateCount;
    }
}

StateSpace::Coordinates StateSpace::coordinates(Index state) const
{
    Coordinates result;
    const Index plane = planeOf(state);
    const Index cell = cellOf(state);
    Index cells = m_cellCount;
    Index planes = m_planeCount;
    for (const KinematicAxis &axis : m_axes) {
        cells /= axis.cells;
        planes /= axis.rateCount;
        result.cells.push_back(cell / cells % axis.cells);
        result.rates.push_back(int(plane / planes % axis.rateCount));
    }
    return result;
}

Index StateSpace::state(const Coordinates &c) const
{
    Index plane = 0;
    Index cell = 0;
    for (std::size_t i = 0; const KinematicAxis &axis : m_axes) {
        plane = plane * axis.rateCount + c.rates[i];
        cell = cell * axis.cells + c.cells[i++];
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
    std::vector<double> rates;
    Index planes = m_planeCount;
    for (const KinematicAxis &axis : m_axes) {
        planes /= axis.rateCount;
        rates.push_back(axis.rate(int(plane / planes % axis.rateCount)));
    }
    return rates;
}

std::vector<StateSpace::Predecessor> StateSpace::predecessors(Index target, Index step) const
{
    const Coordinates to = coordinates(target);
    std::vector<Predecessor> result;
    Coordinates from = to;
    const auto descend = [&](auto &&self, std::size_t axis, double lnProbability) -> void {
        if (axis == to.rates.size()) {
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
    for (auto count = cells.begin(); KinematicAxis & axis : axes) {
        axis.cells = *count++;
        axis.cyclic = false;
    }
    return StateSpace(std::move(axes));
}

} // namespace faintline
