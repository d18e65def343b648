#include "noise/averageWhileSteady.h"

#include "base/fastmath.h"
#include "base/multiversion.h"
#include "noise/blockBackground.h"
#include "noise/constants.h"
#include "noise/levels.h"
#include "noise/medians.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace faintline {

namespace {

    /// Median difference of two rows of ln powers, from at most 500 cells; 0 if it may be due to chance.
    float levelBetween(const float *upper, const float *lower, Index cells, double framesUsed)
    {
        std::vector<float> differences;
        const Index stride = (cells + 499) / 500;
        for (Index cell = 0; cell < cells; cell += stride)
            differences.push_back(upper[cell] - lower[cell]);
        const float level = medianOf(differences);
        const double chance = 3.0 * inverseLn2 * std::sqrt(2.0 * 2.0 / (framesUsed * double(cells)));
        return double(std::abs(level)) < chance ? 0.0f : level;
    }

    /// Numerators and denominators of the cells' means.
    struct Means {
        float *sum;
        float *count;
    };

    /// sum ← sum + e^(values - level - about) where `counts`, which are added up.
    FAINTLINE_MULTIVERSION
    void addRatios(const float *values, float level, const float *about, std::span<const float> counts, Means to)
    {
        for (std::size_t cell = 0; cell < counts.size(); ++cell) {
            const float ratio = fastExp(values[cell] - level - about[cell]);
            to.sum[cell] += counts[cell] > 0.0f ? ratio : 0.0f; // it may be NaN where it does not count
            to.count[cell] += counts[cell];
        }
    }

    /// Shared by all blocks' averages.
    class SteadyAverage
    {
    public:
        SteadyAverage(const std::vector<float> &columns, const std::vector<float> &rows, Index cells, Index half,
                      double framesUsed)
            : m_columns(columns), m_rows(rows), m_cells(cells), m_half(half),
              m_blocks(std::ssize(rows) / std::max<Index>(1, cells)), m_framesUsed(framesUsed),
              m_lnMost(float(std::log(mostNoiseRatio(framesUsed)))), m_tolerance(std::size_t(cells)),
              m_sum(m_tolerance.size()), m_count(m_tolerance.size()), m_counts(m_tolerance.size()),
              m_goesOn(m_tolerance.size())
        {
            for (Index cell = 0; cell < cells; ++cell) {
                const double inward = double(std::min({cell, cells - 1 - cell, half})) / double(half);
                const double effective = pivotCells + (2.0 * double(half) + 1.0 - pivotCells) * inward;
                m_tolerance[std::size_t(cell)] =
                    float(4.0 * inverseLn2 * std::sqrt(2.0 / (framesUsed * effective / 2.0)));
            }
        }

        Index blocks() const { return m_blocks; }

        /// The background of one block, averaged with its neighbours.
        std::vector<float> backgroundOf(Index block)
        {
            const float *own = m_rows.data() + block * m_cells;
            std::fill(m_sum.begin(), m_sum.end(), 0.0f);
            std::fill(m_count.begin(), m_count.end(), 0.0f);
            std::fill(m_goesOn.begin(), m_goesOn.end(), 1);
            add(block, 0.0f, own);
            double blocksAveraged = 1.0;
            for (Index direction : {-1, 1}) {
                std::fill(m_goesOn.begin(), m_goesOn.end(), 1);
                for (Index i = 1; i <= steadyBlocks; ++i) {
                    const Index other = block + direction * i;
                    if (other < 0 || other >= m_blocks)
                        break;
                    const float *smooth = m_rows.data() + other * m_cells;
                    const float level = levelBetween(smooth, own, m_cells, m_framesUsed);
                    if (std::abs(level) > 1.0f)
                        break;
                    for (std::size_t cell = 0; cell < m_tolerance.size(); ++cell)
                        m_goesOn[cell] =
                            m_goesOn[cell] && std::abs(smooth[cell] - level - own[cell]) <= m_tolerance[cell];
                    add(other, level, own);
                    blocksAveraged += 1.0;
                }
            }
            std::vector<float> column(m_tolerance.size());
            const float *medians = m_columns.data() + block * m_cells;
            for (std::size_t cell = 0; cell < column.size(); ++cell)
                column[cell] = m_count[cell] > 0.0f ? own[cell] + std::log(m_sum[cell] / m_count[cell]) : medians[cell];
            std::vector<float> background = runningMedian(column, m_half);
            refine(column, background, m_half,
                   std::max(leastNoiseRatio, mostNoiseRatio(m_framesUsed * blocksAveraged)));
            const float least = *std::min_element(own, own + m_cells); // floor of rounding errors
            for (float &value : background)
                value = std::max(value, least);
            return background;
        }

    private:
        void add(Index other, float level, const float *own)
        {
            const float *values = m_columns.data() + other * m_cells;
            const float *smooth = m_rows.data() + other * m_cells;
            for (std::size_t cell = 0; cell < m_counts.size(); ++cell)
                m_counts[cell] = m_goesOn[cell] && std::abs(values[cell] - smooth[cell]) < m_lnMost ? 1.0f : 0.0f;
            addRatios(values, level, own, m_counts, {m_sum.data(), m_count.data()});
        }

        const std::vector<float> &m_columns;
        const std::vector<float> &m_rows;
        Index m_cells;
        Index m_half;
        Index m_blocks;
        double m_framesUsed;
        float m_lnMost;
        std::vector<float> m_tolerance;
        std::vector<float> m_sum;
        std::vector<float> m_count;
        std::vector<float> m_counts;
        std::vector<char> m_goesOn;
    };

} // namespace

void averageWhileSteady(std::vector<float> &columns, const std::vector<float> &rows, Index cells, Index half,
                        double framesUsed)
{
    SteadyAverage average(columns, rows, cells, half, framesUsed);
    std::deque<std::vector<float>> finished; // the last blocks, whose own medians are still needed
    for (Index block = 0; block < average.blocks(); ++block) {
        finished.push_back(average.backgroundOf(block));
        if (std::ssize(finished) > steadyBlocks) {
            std::copy(finished.front().begin(), finished.front().end(),
                      columns.begin() + (block - steadyBlocks) * cells);
            finished.pop_front();
        }
    }
    for (Index block = average.blocks() - std::ssize(finished); block < average.blocks(); ++block) {
        std::copy(finished.front().begin(), finished.front().end(), columns.begin() + block * cells);
        finished.pop_front();
    }
}

std::vector<float> averageOfLatest(const std::vector<float> &columns, const std::vector<float> &rows, Index cells,
                                   Index half, double framesUsed)
{
    SteadyAverage average(columns, rows, cells, half, framesUsed);
    return average.backgroundOf(average.blocks() - 1);
}

} // namespace faintline
