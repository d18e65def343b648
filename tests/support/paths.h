#pragma once

#include "model/KinematicAxis.h"
#include "model/StateSpace.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace faintline::test {

/// An axis of cells with rates of whole cells a step.
inline KinematicAxis rated(Index cells, bool cyclic, int firstRate, int rateCount, std::vector<double> h,
                           Rounding rounding = Rounding::HalfDown)
{
    return {"a", cells, cyclic, firstRate, rateCount, std::move(h), {}, rounding};
}

/// The same with rates of 1/ratesPerCell.
inline KinematicAxis fractional(Index cells, bool cyclic, int ratesPerCell, int firstRate, int rateCount,
                                std::vector<double> h)
{
    KinematicAxis axis = rated(cells, cyclic, firstRate, rateCount, std::move(h));
    axis.ratesPerCell = ratesPerCell;
    return axis;
}

/// The transition law straight from its definition, for one axis: P(p', r' | p, r) in step number `step`. Shares no
/// code with the recursion.
inline double axisProbability(const KinematicAxis &axis, Index p, int rateIndex, Index pNext, int rateIndexNext,
                              Index step = 0)
{
    const auto displaced = [&](Index displacement) {
        if (!axis.cyclic)
            return pNext - p == displacement;
        const Index difference = pNext - p - displacement;
        return difference % axis.cells == 0;
    };
    if (!axis.step.empty()) {
        double sum = 0.0;
        for (Index delta = -(std::ssize(axis.step) - 1); delta < std::ssize(axis.step); ++delta)
            if (displaced(delta))
                sum = std::max(sum, axis.step[std::size_t(std::abs(delta))]);
        return sum;
    }
    const int change = std::abs(rateIndexNext - rateIndex);
    if (change >= int(axis.rateChange.size()))
        return 0.0;
    if (axis.ratesPerCell > 1) { // the rounded place on a straight line, minus that of the step before
        const double slope = double(axis.firstRate + rateIndexNext) / axis.ratesPerCell;
        const auto reached = [&](Index t) { return std::floor(slope * double(t) + 0.5); };
        const auto displacement = Index(reached(step + 1) - reached(step));
        return displaced(displacement) ? axis.rateChange[std::size_t(change)] : 0.0;
    }
    const double mean = 0.5 * (axis.firstRate + rateIndex + axis.firstRate + rateIndexNext);
    // Half-open interval: -1/2 <= displacement - mean < 1/2; or the part toward zero.
    const double displacement = axis.rounding == Rounding::Trunc ? std::trunc(mean) : std::ceil(mean - 0.5);
    return displaced(Index(displacement)) ? axis.rateChange[std::size_t(change)] : 0.0;
}

/// P(n | m) of two states in step number `step`: the product over the axes.
inline double transitionProbability(const StateSpace &space, Index from, Index to, Index step = 0)
{
    const StateSpace::Coordinates a = space.coordinates(from);
    const StateSpace::Coordinates b = space.coordinates(to);
    double product = 1.0;
    for (std::size_t i = 0; i < space.axes().size(); ++i)
        product *= axisProbability(space.axes()[i], a.cells[i], a.rates[i], b.cells[i], b.rates[i], step);
    return product;
}

/// Calls visit(path) for every sequence of states of the given length that ends in `last`, whatever its probability.
inline void forEachPath(Index stateCount, Index length, Index last,
                        const std::function<void(const std::vector<Index> &)> &visit)
{
    std::vector<Index> path(std::size_t(length), 0);
    path.back() = last;
    const std::function<void(std::size_t)> descend = [&](std::size_t position) {
        if (position + 1 == path.size()) {
            visit(path);
            return;
        }
        for (Index state = 0; state < stateCount; ++state) {
            path[position] = state;
            descend(position + 1);
        }
    };
    descend(0);
}

} // namespace faintline::test
