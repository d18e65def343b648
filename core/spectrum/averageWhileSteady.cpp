#include "spectrum/averageWhileSteady.h"

#include "base/fastmath.h"
#include "base/multiversion.h"
#include "spectrum/blockBackground.h"
#include "spectrum/levels.h"
#include "spectrum/medians.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace faintline {

namespace {

    constexpr double leastNoiseRatio = 1.3; // the noise's shape itself differs from its running median by as much

    /// How much higher a whole row of ln powers lies than another: the median difference, of 500 cells if there are
    /// more; 0 where it may be chance.
    float levelBetween(const float *upper, const float *lower, Index cells, double framesUsed)
    {
        std::vector<float> differences;
        const Index stride = (cells + 499) / 500;
        for (Index cell = 0; cell < cells; cell += stride)
            differences.push_back(upper[cell] - lower[cell]);
        const float level = medianOf(differences);
        const double chance = 3.0 * inverseLn2 * std::sqrt(2.0 * 2.0 / (framesUsed * static_cast<double>(cells)));
        return static_cast<double>(std::abs(level)) < chance ? 0.0f : level;
    }

    /// out ← out + e^(values - level - about) where `counts`, which is counted.
    FAINTLINE_MULTIVERSION
    void addRatios(const float *values, float level, const float *about, const float *counts, std::size_t cells,
                   float *sum, float *count)
    {
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const float ratio = fastExp(values[cell] - level - about[cell]);
            sum[cell] += counts[cell] > 0.0f ? ratio : 0.0f; // it may be no number where it does not count
            count[cell] += counts[cell];
        }
    }

} // namespace

void averageWhileSteady(std::vector<float> &columns, const std::vector<float> &rows, Index cells, Index half,
                        double framesUsed)
{
    constexpr Index reach = 6;
    const Index blocks = std::ssize(rows) / std::max<Index>(1, cells);
    std::vector<float> tolerance(static_cast<std::size_t>(cells));
    for (Index cell = 0; cell < cells; ++cell) {
        const double inward = static_cast<double>(std::min({cell, cells - 1 - cell, half})) / static_cast<double>(half);
        const double effective = pivotCells + (2.0 * static_cast<double>(half) + 1.0 - pivotCells) * inward;
        tolerance[static_cast<std::size_t>(cell)] =
            static_cast<float>(4.0 * inverseLn2 * std::sqrt(2.0 / (framesUsed * effective / 2.0)));
    }
    const double mostRatio = mostNoiseRatio(framesUsed);
    const auto lnMost = static_cast<float>(std::log(mostRatio));
    std::vector<float> sum(tolerance.size());
    std::vector<float> count(tolerance.size());
    std::vector<float> counts(tolerance.size());
    std::vector<char> goesOn(tolerance.size());
    std::deque<std::vector<float>> finished; // the last blocks, whose own medians are still asked for
    for (Index block = 0; block < blocks; ++block) {
        const float *own = rows.data() + block * cells;
        std::fill(sum.begin(), sum.end(), 0.0f);
        std::fill(count.begin(), count.end(), 0.0f);
        const auto add = [&](Index other, float level) {
            const float *values = columns.data() + other * cells;
            const float *smooth = rows.data() + other * cells;
            for (std::size_t cell = 0; cell < counts.size(); ++cell)
                counts[cell] = goesOn[cell] && std::abs(values[cell] - smooth[cell]) < lnMost ? 1.0f : 0.0f;
            addRatios(values, level, own, counts.data(), counts.size(), sum.data(), count.data());
        };
        std::fill(goesOn.begin(), goesOn.end(), 1);
        add(block, 0.0f);
        double blocksAveraged = 1.0;
        for (Index direction : {-1, 1}) {
            std::fill(goesOn.begin(), goesOn.end(), 1);
            for (Index i = 1; i <= reach; ++i) {
                const Index other = block + direction * i;
                if (other < 0 || other >= blocks)
                    break;
                const float *smooth = rows.data() + other * cells;
                const float level = levelBetween(smooth, own, cells, framesUsed);
                if (std::abs(level) > 1.0f)
                    break;
                for (std::size_t cell = 0; cell < tolerance.size(); ++cell)
                    goesOn[cell] = goesOn[cell] && std::abs(smooth[cell] - level - own[cell]) <= tolerance[cell];
                add(other, level);
                blocksAveraged += 1.0;
            }
        }
        std::vector<float> column(tolerance.size());
        const float *medians = columns.data() + block * cells;
        for (std::size_t cell = 0; cell < column.size(); ++cell)
            column[cell] = count[cell] > 0.0f ? own[cell] + std::log(sum[cell] / count[cell]) : medians[cell];
        std::vector<float> background = runningMedian(column, half);
        refine(column, background, half, std::max(leastNoiseRatio, mostNoiseRatio(framesUsed * blocksAveraged)));
        const float least = *std::min_element(own, own + cells); // the floor of rounding
        for (float &value : background)
            value = std::max(value, least);
        finished.push_back(std::move(background));
        if (std::ssize(finished) > reach) {
            std::copy(finished.front().begin(), finished.front().end(), columns.begin() + (block - reach) * cells);
            finished.pop_front();
        }
    }
    for (Index block = blocks - std::ssize(finished); block < blocks; ++block) {
        std::copy(finished.front().begin(), finished.front().end(), columns.begin() + block * cells);
        finished.pop_front();
    }
}

} // namespace faintline
