#include "noise/pings/guessPingValues.h"

#include "noise/constants.h"
#include "noise/levels.h"
#include "noise/pings/pingBlock.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace faintline {

namespace {

    constexpr Index mostPings = 64;
    constexpr Index guessedValues = Index(1) << 22;
    constexpr std::size_t fewestValues = 4096;
    const double powerRatio = std::log(3.0); ///< median |ln ratio| of two exponentials

    std::vector<std::vector<double>> somePings(const RawPings &pings)
    {
        const Index count = pings.info().time.count;
        const Index affordable = std::clamp<Index>(guessedValues / pings.cells(), 2, mostPings);
        const Index pairs = std::max<Index>(1, std::min(affordable, count) / 2);
        std::vector<std::vector<double>> result;
        for (Index pair = 0; pair < pairs; ++pair)
            for (Index ping = pair * count / pairs; ping < std::min(count, pair * count / pairs + 2); ++ping) {
                result.emplace_back(std::size_t(pings.cells()));
                pings.read(ping, 1, result.back());
            }
        return result;
    }

    double median(std::vector<float> &values)
    {
        return values.empty() ? 0.0 : double(medianOf(values));
    }

    /// Medians of the values of up to eight stretches of range, each in all beams, and of each beam.
    std::vector<double> partMedians(const std::vector<std::vector<double>> &pings, const BeamLayout &layout)
    {
        const Index count = std::min<Index>(8, layout.ranges());
        std::vector<std::vector<float>> values(std::size_t(count + layout.beams()));
        for (const std::vector<double> &ping : pings)
            for (Index beam = 0; beam < layout.beams(); ++beam)
                for (Index range = 0; range < layout.ranges(); ++range)
                    if (const double x = ping[std::size_t(layout.cell(beam, range))]; std::isfinite(x)) {
                        values[std::size_t(range * count / layout.ranges())].push_back(float(x));
                        values[std::size_t(count + beam)].push_back(float(x));
                    }
        std::vector<double> medians;
        for (std::vector<float> &part : values)
            if (!part.empty())
                medians.push_back(median(part));
        return medians;
    }

    /// Whether the noise has the same level everywhere, as after a normalisation.
    bool isLevel(const std::vector<double> &medians)
    {
        const auto [low, high] = std::minmax_element(medians.begin(), medians.end());
        return !medians.empty() && *high <= levelMediansRatio * *low && *low >= 0.1 * std::numbers::ln2
               && *high <= 10.0 * std::numbers::ln2;
    }

} // namespace

PingValues guessPingValues(const RawPings &pings)
{
    if (pings.info().isComplex)
        return PingValues::Power;
    const std::vector<std::vector<double>> some = somePings(pings);
    const auto isNegative = [](double x) { return x < 0.0; };
    const bool anyNegative = std::ranges::any_of(
        some, [&](const std::vector<double> &ping) { return std::ranges::any_of(ping, isNegative); });
    const std::size_t values = some.size() * std::size_t(pings.cells());
    if (pings.info().quantum == 0.0 && !anyNegative
        && (values < fewestValues || isLevel(partMedians(some, BeamLayout(pings.info().grid)))))
        return PingValues::Normalised;
    std::vector<float> ratios;
    std::vector<float> differences;
    for (std::size_t i = 0; i + 1 < some.size(); i += 2)
        for (std::size_t cell = 0; cell < some[i].size(); ++cell) {
            const double a = some[i][cell];
            const double b = some[i + 1][cell];
            if (!std::isfinite(a) || !std::isfinite(b))
                continue;
            differences.push_back(float(std::abs(a - b)));
            if (a > 0.0 && b > 0.0)
                ratios.push_back(float(std::abs(std::log(a / b))));
        }
    const double ratio = median(ratios);
    const double decibels = median(differences) / (10.0 * powerRatio / std::numbers::ln10);
    if (anyNegative || (ratio < 0.5 * 0.5 * powerRatio && decibels > 0.5 && decibels < 2.0))
        return PingValues::Decibels;
    return ratio < std::sqrt(0.5) * powerRatio ? PingValues::Magnitude : PingValues::Power;
}

} // namespace faintline
