#include "model/SequentialModel.h"

#include "base/Error.h"
#include "base/Field.h"
#include "base/logmath.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace faintline {

std::vector<double> SequentialModel::initialLaw() const
{
    const Index states = markov.space.stateCount();
    return initial.empty() ? std::vector<double>(std::size_t(states), 1.0 / double(states)) : initial;
}

void SequentialModel::check(const std::string &where) const
{
    if (reduction.stateCells() != markov.space.cellCount())
        throw Error(where, "has " + std::to_string(markov.space.cellCount()) + " cells, but the reduced frames have "
                               + std::to_string(reduction.stateCells()));
    if (observedEvery < 1)
        throw Error(where + ".observedEvery = " + std::to_string(observedEvery), "must be at least 1");
    if (markov.transitionScale != 1.0)
        throw Error(where, "has scaled transitions, which are not probabilities");
    for (const KinematicAxis &axis : markov.space.axes())
        if (const double loss = axis.largestLoss(); loss > 1e-12)
            throw Error(where, "has an axis" + (axis.name.empty() ? std::string() : " of " + axis.name)
                                   + " that loses up to " + formatNumber(100.0 * loss)
                                   + " % of a target's probability per stage; a "
                                     "likelihood ratio needs a lossless law");
    if (initial.empty())
        return;
    if (std::ssize(initial) != markov.space.stateCount())
        throw Error(where + ".initial", "holds " + std::to_string(initial.size()) + " probabilities; there are "
                                            + std::to_string(markov.space.stateCount()) + " states");
    double sum = 0.0;
    for (const double p : initial) {
        if (!(p >= 0.0 && p <= 1.0))
            throw Error(where + ".initial", "holds " + formatNumber(p) + "; a probability must lie in 0 … 1");
        sum += p;
    }
    if (std::abs(sum - 1.0) > 1e-6)
        throw Error(where + ".initial", "adds up to " + formatNumber(sum) + "; it must be 1");
}

SequentialModel makeSequentialModel(const std::vector<KinematicAxis> &frameAxes, const std::vector<bool> &isFolded,
                                    const Likelihood &likelihood, std::vector<double> initial)
{
    std::vector<Index> cells;
    std::vector<KinematicAxis> axes;
    for (std::size_t i = 0; i < frameAxes.size(); ++i) {
        frameAxes[i].check("model.axes[" + std::to_string(i) + "]");
        cells.push_back(frameAxes[i].cells);
        if (!isFolded[i])
            axes.push_back(frameAxes[i].stochastic("model.axes[" + std::to_string(i) + "]"));
    }
    if (axes.empty()) {
        axes.emplace_back();
        axes.back().cells = 1;
    }
    // Constructed separately, because GCC 12 mishandles a braced list in which a later member throws.
    StateSpace space(std::move(axes));
    CellReduction reduction(std::move(cells), isFolded);
    SequentialModel model{{std::move(space), likelihood, 1.0}, std::move(reduction), std::move(initial), 1};
    model.check("model");
    constexpr double rounding = 1e-14;
    if (const double sum = std::accumulate(model.initial.begin(), model.initial.end(), 0.0);
        !model.initial.empty() && std::abs(sum - 1.0) > rounding)
        for (double &p : model.initial)
            p /= sum;
    return model;
}

CellReduction::CellReduction(std::vector<Index> cells, const std::vector<bool> &isFolded)
    : m_cells(std::move(cells)), m_isFolded(isFolded)
{
    for (std::size_t axis = 0; axis < m_cells.size(); ++axis) {
        if (double(m_frameCells) * double(m_cells[axis]) > 0x1p31) // before the product can overflow
            throw Error("model.axes", "give more than 2³¹ cells");
        m_frameCells *= m_cells[axis];
        if (!isFolded[axis])
            m_stateCells *= m_cells[axis];
    }
    m_stateCell.reserve(std::size_t(m_frameCells));
    for (Index cell = 0; cell < m_frameCells; ++cell) {
        Index state = 0;
        Index below = m_frameCells;
        for (std::size_t axis = 0; axis < m_cells.size(); ++axis) {
            below /= m_cells[axis];
            if (!isFolded[axis])
                state = state * m_cells[axis] + cell / below % m_cells[axis];
        }
        m_stateCell.push_back(state);
    }
}

void CellReduction::sum(std::span<const double> lambda, std::span<double> reduced) const
{
    if (m_frameCells == m_stateCells) {
        std::copy(lambda.begin(), lambda.end(), reduced.begin());
        return;
    }
    std::vector<double> highest(reduced.size(), minusInfinity);
    for (std::size_t cell = 0; cell < lambda.size(); ++cell) {
        double &high = highest[std::size_t(m_stateCell[cell])];
        high = std::max(high, lambda[cell]);
    }
    std::fill(reduced.begin(), reduced.end(), 0.0);
    for (std::size_t cell = 0; cell < lambda.size(); ++cell) {
        const auto state = std::size_t(m_stateCell[cell]);
        reduced[state] += std::exp(lambda[cell] - highest[state]);
    }
    const double lnFolded = std::log(double(foldedCells()));
    for (std::size_t state = 0; state < reduced.size(); ++state)
        reduced[state] = highest[state] + std::log(reduced[state]) - lnFolded;
}

void CellReduction::maximum(std::span<const double> lambda, std::span<double> reduced) const
{
    if (m_frameCells == m_stateCells) {
        std::copy(lambda.begin(), lambda.end(), reduced.begin());
        return;
    }
    std::fill(reduced.begin(), reduced.end(), minusInfinity);
    for (std::size_t cell = 0; cell < lambda.size(); ++cell) {
        double &high = reduced[std::size_t(m_stateCell[cell])];
        high = std::max(high, lambda[cell]);
    }
    const double lnFolded = std::log(double(foldedCells()));
    for (double &value : reduced)
        value -= lnFolded;
}

std::vector<Index> CellReduction::best(std::span<const double> lambda, Index stateCell) const
{
    Index found = -1;
    for (Index cell = 0; cell < m_frameCells; ++cell)
        if (m_stateCell[std::size_t(cell)] == stateCell
            && (found < 0 || lambda[std::size_t(cell)] > lambda[std::size_t(found)]))
            found = cell;
    std::vector<Index> coordinates(m_cells.size());
    for (std::size_t axis = m_cells.size(); axis-- > 0;) {
        coordinates[axis] = found % m_cells[axis];
        found /= m_cells[axis];
    }
    return coordinates;
}

} // namespace faintline
