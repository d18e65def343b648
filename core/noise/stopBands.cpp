#include "noise/stopBands.h"

#include "noise/constants.h"
#include "noise/medians.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>

namespace faintline {

namespace {

    using Rows = std::vector<std::vector<double>>; ///< ln power, times × cells

    double meanOf(std::span<const double> values)
    {
        return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
    }

    /// Whether the level of the cells from `begin` on follows that of `count` cells from `from` on.
    bool follows(const Rows &rows, Index begin, Index from, Index count)
    {
        std::vector<double> low, high;
        for (const std::vector<double> &row : rows) {
            low.push_back(meanOf(std::span(row).subspan(std::size_t(begin))));
            high.push_back(meanOf(std::span(row).subspan(std::size_t(from), std::size_t(count))));
        }
        const double meanLow = meanOf(low);
        const double meanHigh = meanOf(high);
        double squaresLow = 0.0, squaresHigh = 0.0, products = 0.0;
        for (std::size_t i = 0; i < low.size(); ++i) {
            squaresLow += (low[i] - meanLow) * (low[i] - meanLow);
            squaresHigh += (high[i] - meanHigh) * (high[i] - meanHigh);
            products += (low[i] - meanLow) * (high[i] - meanHigh);
        }
        return squaresHigh >= steadyLevelNats * steadyLevelNats * double(low.size())
               && products >= followingSlope * squaresHigh
               && products >= followingCorrelation * std::sqrt(squaresLow * squaresHigh);
    }

    struct UpperEnd {
        Index cells = 0;
        double depth = 0.0; ///< nat below the band beside it
    };

    std::optional<UpperEnd> stopAtUpperEnd(const Rows &rows)
    {
        const auto cells = std::ssize(rows.front());
        std::vector<double> mean(std::size_t(cells), 0.0);
        for (const std::vector<double> &row : rows)
            for (std::size_t cell = 0; cell < mean.size(); ++cell)
                mean[cell] += row[cell] / double(rows.size());
        std::vector<double> sorted = mean;
        const auto quartile = sorted.begin() + std::ptrdiff_t(3 * sorted.size() / 4);
        std::ranges::nth_element(sorted, quartile);
        Index begin = cells;
        while (begin > 0 && mean[std::size_t(begin - 1)] <= *quartile - stopFallNats)
            --begin;
        const Index width = cells - begin;
        const Index edge = std::max<Index>(2, cells / 20); // where the filter falls
        const Index pass = begin - edge / 2;               // end of what it passes
        const Index beside = std::min(width, pass);
        if (width < std::max<Index>(2, cells / 50) || begin < edge || beside < width / 4 + 1)
            return {};
        const double inside = *std::max_element(mean.begin() + begin - edge, mean.begin() + pass);
        const double depth = inside - meanOf(std::span(mean).subspan(std::size_t(begin)));
        if (depth < stopFallNats || !follows(rows, begin, pass - beside, beside))
            return {};
        return UpperEnd{width, depth};
    }

} // namespace

std::vector<StopBand> stopBands(const Axis &frequency, std::vector<std::vector<double>> lnPower, bool isComplex)
{
    if (std::ssize(lnPower) < fewestStopTimes)
        return {};
    const double first = frequency.value(-0.5);
    const double end = frequency.value(double(frequency.count) - 0.5);
    std::vector<StopBand> bands;
    if (const auto upper = stopAtUpperEnd(lnPower))
        bands.push_back({end - frequency.step * double(upper->cells), end, upper->depth});
    if (!isComplex)
        return bands;
    for (std::vector<double> &row : lnPower)
        std::ranges::reverse(row);
    if (const auto lower = stopAtUpperEnd(lnPower))
        bands.insert(bands.begin(), {first, first + frequency.step * double(lower->cells), lower->depth});
    return bands;
}

std::vector<StopBand> stopBands(const Spectrogram &spectrogram)
{
    const RecordingInfo &info = spectrogram.recording().info();
    const Index samples = (spectrogram.time().count - 1) * spectrogram.hopSamples() + spectrogram.windowSamples();
    if (!isWholeBand(spectrogram.selection()) || samples < stopSpectrumSamples * fewestStopTimes * stopSpectraPerTime)
        return {};
    const SpectrogramSettings settings{double(stopSpectrumSamples) / info.sampleRateHz, 1, 1,
                                       spectrogram.settings().window};
    const Spectrogram spectra(spectrogram.recordingPointer(), settings, spectrogram.selection());
    const Index count = spectra.time().count;
    const Index times = std::min(mostStopTimes, count / stopSpectraPerTime);
    const auto cells = std::size_t(spectra.frequency().count);
    Rows rows;
    std::vector<float> y(cells * std::size_t(stopSpectraPerTime));
    std::vector<float> medians(cells);
    for (Index time = 0; time < times; ++time) {
        for (Index i = 0; i < stopSpectraPerTime; ++i)
            spectra.read((time * stopSpectraPerTime + i) * count / (times * stopSpectraPerTime), 1,
                         std::span(y).subspan(std::size_t(i) * cells, cells));
        columnMedians(y, medians);
        if (*std::ranges::min_element(medians) <= 0.0f) // silence, or a gap
            continue;
        std::vector<double> &row = rows.emplace_back();
        for (const float median : medians)
            row.push_back(std::log(double(median)));
    }
    return stopBands(spectra.frequency(), std::move(rows), info.isComplex);
}

std::pair<Index, Index> cellsIn(const StopBand &band, const Axis &frequency)
{
    const Index first = std::clamp<Index>(Index(std::ceil(frequency.position(band.lowHz))), 0, frequency.count);
    const Index end = std::clamp<Index>(Index(std::floor(frequency.position(band.highHz))) + 1, first, frequency.count);
    return {first, end};
}

} // namespace faintline
