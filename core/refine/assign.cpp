#include "refine/assign.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace faintline {

namespace {

    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    /// Indices of pairs, grouped by connected component of the graph that they form.
    std::vector<std::vector<std::size_t>> componentsOf(const std::vector<PairCost> &pairs,
                                                       const std::vector<std::size_t> &chosen)
    {
        std::size_t froms = 0;
        std::size_t tos = 0;
        for (const std::size_t i : chosen) {
            froms = std::max(froms, pairs[i].from + 1);
            tos = std::max(tos, pairs[i].to + 1);
        }
        std::vector<std::size_t> parent(froms + tos);
        std::iota(parent.begin(), parent.end(), std::size_t(0));
        const auto rootOf = [&](std::size_t node) {
            while (parent[node] != node)
                node = parent[node] = parent[parent[node]];
            return node;
        };
        for (const std::size_t i : chosen)
            parent[rootOf(pairs[i].from)] = rootOf(froms + pairs[i].to);
        std::map<std::size_t, std::size_t> numbers;
        std::vector<std::vector<std::size_t>> components;
        for (const std::size_t i : chosen) {
            const auto [at, isNew] = numbers.try_emplace(rootOf(pairs[i].from), components.size());
            if (isNew)
                components.emplace_back();
            components[at->second].push_back(i);
        }
        return components;
    }

    /// One component: its `from` are rows, its `to` columns, followed by one column per row that means "nothing".
    class Component
    {
    public:
        Component(const std::vector<PairCost> &pairs, const std::vector<std::size_t> &numbers, double unassigned)
        {
            std::map<std::size_t, std::size_t> rows;
            std::map<std::size_t, std::size_t> columns;
            for (const std::size_t i : numbers) {
                rows.try_emplace(pairs[i].from, rows.size());
                columns.try_emplace(pairs[i].to, columns.size());
            }
            m_rows = rows.size();
            m_columns = columns.size() + m_rows;
            m_cost.assign(m_rows * m_columns, unassigned);
            m_pair.assign(m_rows * m_columns, none);
            for (const std::size_t i : numbers) {
                const std::size_t at = rows[pairs[i].from] * m_columns + columns[pairs[i].to];
                if (m_pair[at] != none && m_cost[at] <= pairs[i].cost)
                    continue;
                m_cost[at] = pairs[i].cost;
                m_pair[at] = i;
            }
        }

        void solveInto(std::vector<std::size_t> &chosen)
        {
            // Row and column 0 are auxiliary: column 0 holds the row that is being inserted.
            std::vector<double> rowPotential(m_rows + 1);
            std::vector<double> columnPotential(m_columns + 1);
            std::vector<std::size_t> rowOf(m_columns + 1, 0);
            for (std::size_t row = 1; row <= m_rows; ++row) {
                rowOf[0] = row;
                augment(rowPotential, columnPotential, rowOf);
            }
            for (std::size_t column = 1; column <= m_columns; ++column)
                if (rowOf[column] != 0)
                    if (const std::size_t pair = m_pair[(rowOf[column] - 1) * m_columns + column - 1]; pair != none)
                        chosen.push_back(pair);
        }

    private:
        void augment(std::vector<double> &rowPotential, std::vector<double> &columnPotential,
                     std::vector<std::size_t> &rowOf) const
        {
            std::vector<double> least(m_columns + 1, std::numeric_limits<double>::infinity());
            std::vector<std::size_t> before(m_columns + 1, 0);
            std::vector<bool> isReached(m_columns + 1, false);
            std::size_t column = 0;
            do {
                isReached[column] = true;
                const std::size_t row = rowOf[column];
                double step = std::numeric_limits<double>::infinity();
                std::size_t next = 0;
                for (std::size_t c = 1; c <= m_columns; ++c) {
                    if (isReached[c])
                        continue;
                    const double reduced =
                        m_cost[(row - 1) * m_columns + c - 1] - rowPotential[row] - columnPotential[c];
                    if (reduced < least[c]) {
                        least[c] = reduced;
                        before[c] = column;
                    }
                    if (least[c] < step) {
                        step = least[c];
                        next = c;
                    }
                }
                for (std::size_t c = 0; c <= m_columns; ++c) {
                    if (isReached[c]) {
                        rowPotential[rowOf[c]] += step;
                        columnPotential[c] -= step;
                    } else {
                        least[c] -= step;
                    }
                }
                column = next;
            } while (rowOf[column] != 0);
            while (column != 0) {
                rowOf[column] = rowOf[before[column]];
                column = before[column];
            }
        }

        std::size_t m_rows = 0;
        std::size_t m_columns = 0;
        std::vector<double> m_cost;      ///< rows × columns
        std::vector<std::size_t> m_pair; ///< of each entry; none: "nothing"
    };

} // namespace

std::vector<std::size_t> assign(const std::vector<PairCost> &pairs, double unassigned)
{
    std::vector<std::size_t> possible;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (pairs[i].cost < unassigned)
            possible.push_back(i);
    std::vector<std::size_t> chosen;
    for (const std::vector<std::size_t> &component : componentsOf(pairs, possible)) {
        if (component.size() == 1)
            chosen.push_back(component.front());
        else
            Component(pairs, component, unassigned).solveInto(chosen);
    }
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

} // namespace faintline
