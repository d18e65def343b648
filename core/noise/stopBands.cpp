#include "noise/stopBands.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>

namespace faintline {

namespace {

    constexpr Index fewestCells = 100; ///< in fewer, no end of a spectrum can be told from a line beside it
    constexpr Index mostColumns = 1024;
    constexpr Index fewestTimes = 16;
    constexpr Index mostTimes = 64;
    constexpr Index readsPerTime = 4;
    constexpr double fall = 2.0 * std::numbers::ln10; ///< 20 dB
    constexpr double leastChange = 0.1;               ///< nat, standard deviation; nothing can follow a steady level
    constexpr double leastCorrelation = 0.75;
    constexpr double leastSlope = 0.4;

    double meanOf(std::span<const double> values)
    {
        return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
    }

    /// ln power of a background in up to 64 times and 1024 columns of equal width.
    class Levels
    {
    public:
        explicit Levels(const NoiseBackground &background)
            : m_columns(std::min(background.frequency.count, mostColumns))
        {
            const Axis &axis = background.bandCount > 0 ? background.levelTime : background.time;
            const Index times = std::min(axis.count, mostTimes);
            const Index reads = std::min(readsPerTime, axis.count / std::max<Index>(times, 1));
            const auto cells = std::size_t(background.frequency.count);
            std::vector<float> ln(cells);
            for (Index time = 0; time < times; ++time) {
                std::vector<double> row(std::size_t(m_columns), 0.0);
                bool isSilent = false;
                for (Index read = 0; read < reads; ++read) {
                    background.readLnPower(axis.value(double((time * reads + read) * axis.count / (times * reads))), ln);
                    isSilent = isSilent || *std::ranges::min_element(ln) <= 0.5f * NoiseBackground::silence;
                    for (std::size_t column = 0; column < row.size(); ++column) {
                        const std::size_t from = column * cells / row.size();
                        const std::size_t to = (column + 1) * cells / row.size();
                        row[column] += std::accumulate(ln.begin() + std::ptrdiff_t(from), ln.begin() + std::ptrdiff_t(to), 0.0)
                            / double((to - from) * std::size_t(reads));
                    }
                }
                if (!isSilent)
                    m_rows.push_back(std::move(row));
            }
        }

        Index times() const { return std::ssize(m_rows); }

        /// Exchanges the ends of the spectrum.
        void mirror()
        {
            for (std::vector<double> &row : m_rows)
                std::ranges::reverse(row);
        }

        /// The stop band at the upper end: columns and nat below the rest.
        struct Stop {
            Index columns = 0;
            double depth = 0.0;
        };
        std::optional<Stop> stop() const
        {
            std::vector<double> mean(std::size_t(m_columns), 0.0);
            for (const std::vector<double> &row : m_rows)
                for (std::size_t column = 0; column < mean.size(); ++column)
                    mean[column] += row[column] / double(m_rows.size());
            std::vector<double> sorted = mean;
            const auto quartile = sorted.begin() + std::ptrdiff_t(3 * sorted.size() / 4);
            std::ranges::nth_element(sorted, quartile);
            Index begin = m_columns;
            while (begin > 0 && mean[std::size_t(begin - 1)] <= *quartile - fall)
                --begin;
            const Index columns = m_columns - begin;
            const Index edge = std::max<Index>(2, m_columns / 20);
            if (columns < std::max<Index>(2, m_columns / 50) || begin < edge + columns / 4 + 1)
                return {};
            const double below = meanOf(std::span(mean).subspan(std::size_t(begin)));
            const double beside = *std::max_element(mean.begin() + begin - edge, mean.begin() + begin - edge / 2);
            if (beside - below < fall || !follows(begin, std::max<Index>(0, begin - edge / 2 - columns), begin - edge / 2))
                return {};
            return Stop{columns, beside - below};
        }

    private:
        /// Whether the level from `begin` on follows that of the columns `from` to `to`.
        bool follows(Index begin, Index from, Index to) const
        {
            std::vector<double> low, high;
            for (const std::vector<double> &row : m_rows) {
                low.push_back(meanOf(std::span(row).subspan(std::size_t(begin))));
                high.push_back(meanOf(std::span(row).subspan(std::size_t(from), std::size_t(to - from))));
            }
            const double meanLow = meanOf(low);
            const double meanHigh = meanOf(high);
            double squaresLow = 0.0, squaresHigh = 0.0, products = 0.0;
            for (std::size_t i = 0; i < low.size(); ++i) {
                squaresLow += (low[i] - meanLow) * (low[i] - meanLow);
                squaresHigh += (high[i] - meanHigh) * (high[i] - meanHigh);
                products += (low[i] - meanLow) * (high[i] - meanHigh);
            }
            return squaresHigh >= leastChange * leastChange * double(low.size())
                && products >= leastSlope * squaresHigh
                && products >= leastCorrelation * std::sqrt(squaresLow * squaresHigh);
        }

        Index m_columns;
        std::vector<std::vector<double>> m_rows; ///< of times
    };

} // namespace

std::vector<StopBand> stopBands(const NoiseBackground &background, bool isComplex)
{
    if (background.frequency.count < fewestCells)
        return {};
    Levels levels(background);
    if (levels.times() < fewestTimes)
        return {};
    const Axis &axis = background.frequency;
    const double columns = double(std::min(axis.count, mostColumns));
    const double span = axis.step * double(axis.count);
    const double first = axis.first - 0.5 * axis.step;
    std::vector<StopBand> bands;
    if (const auto upper = levels.stop())
        bands.push_back({first + span * (1.0 - double(upper->columns) / columns), first + span, upper->depth});
    levels.mirror();
    if (const auto lower = isComplex ? levels.stop() : std::nullopt)
        bands.insert(bands.begin(), {first, first + span * double(lower->columns) / columns, lower->depth});
    return bands;
}

} // namespace faintline
