#include "noise/stopBands.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

namespace faintline {

namespace {

    constexpr Index windowSamples = 1024;
    constexpr Index fewestTimes = 16;
    constexpr Index mostTimes = 64;
    constexpr Index framesPerTime = 8;
    constexpr double fall = 2.0 * std::numbers::ln10; ///< 20 dB
    constexpr double leastChange = 0.1;               ///< nat, standard deviation; nothing can follow a steady level
    constexpr double leastCorrelation = 0.75;
    constexpr double leastSlope = 0.4;

    double meanOf(std::span<const double> values)
    {
        return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
    }

    /// ln power, times × cells, in which ends of the spectrum are compared with the rest.
    class Levels
    {
    public:
        explicit Levels(std::vector<std::vector<double>> rows)
            : m_columns(std::ssize(rows.front())), m_rows(std::move(rows))
        {
        }

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

std::vector<StopBand> stopBands(const Axis &frequency, std::vector<std::vector<double>> lnPower, bool isComplex)
{
    if (std::ssize(lnPower) < fewestTimes)
        return {};
    Levels levels(std::move(lnPower));
    const double first = frequency.value(-0.5);
    const double end = frequency.value(double(frequency.count) - 0.5);
    std::vector<StopBand> bands;
    if (const auto upper = levels.stop())
        bands.push_back({end - frequency.step * double(upper->columns), end, upper->depth});
    levels.mirror();
    if (const auto lower = isComplex ? levels.stop() : std::nullopt)
        bands.insert(bands.begin(), {first, first + frequency.step * double(lower->columns), lower->depth});
    return bands;
}

std::vector<StopBand> stopBands(const Spectrogram &spectrogram)
{
    const RecordingInfo &info = spectrogram.recording().info();
    if (!isWholeBand(spectrogram.selection()) || info.sampleCount < windowSamples * fewestTimes * framesPerTime)
        return {};
    const SpectrogramSettings settings{double(windowSamples) / info.sampleRateHz, 1, 1, spectrogram.settings().window};
    const Spectrogram spectra(spectrogram.recordingPointer(), settings, spectrogram.selection());
    const Index frames = spectra.time().count;
    const Index times = std::min(mostTimes, frames / framesPerTime);
    const auto cells = std::size_t(spectra.frequency().count);
    std::vector<std::vector<double>> rows;
    std::vector<float> y(cells * std::size_t(framesPerTime));
    for (Index time = 0; time < times; ++time) {
        for (Index i = 0; i < framesPerTime; ++i)
            spectra.read((time * framesPerTime + i) * frames / (times * framesPerTime), 1,
                         std::span(y).subspan(std::size_t(i) * cells, cells));
        std::vector<double> row;
        std::vector<float> cell(std::size_t(framesPerTime), 0.0f);
        for (std::size_t column = 0; column < cells; ++column) {
            for (std::size_t i = 0; i < cell.size(); ++i)
                cell[i] = y[i * cells + column];
            const auto middle = cell.begin() + framesPerTime / 2;
            std::nth_element(cell.begin(), middle, cell.end());
            row.push_back(std::log(double(*middle)));
        }
        if (std::ranges::all_of(row, [](double ln) { return std::isfinite(ln); })) // neither silent nor a gap
            rows.push_back(std::move(row));
    }
    return stopBands(spectra.frequency(), std::move(rows), info.isComplex);
}

} // namespace faintline
