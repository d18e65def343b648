#include "model/CellReduction.h"

#include "base/Error.h"
#include "base/logmath.h"

#include <algorithm>
#include <cmath>

namespace faintline {

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
