#include "noise/levels.h"

#include "base/multiversion.h"
#include "noise/constants.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace faintline {

namespace {

    constexpr int scales = 7;

    /// Reflects an index beyond the ends of a series into it.
    std::ptrdiff_t reflected(std::ptrdiff_t i, std::ptrdiff_t n)
    {
        if (n == 1)
            return 0;
        const std::ptrdiff_t period = 2 * (n - 1);
        i = std::abs(i) % period;
        return i < n ? i : period - i;
    }

    /// ¼ x(i - lag) + ½ x(i) + ¼ x(i + lag)
    std::vector<double> smoothed(const std::vector<double> &x, std::ptrdiff_t lag)
    {
        const std::ptrdiff_t n = std::ssize(x);
        std::vector<double> result(x.size());
        for (std::ptrdiff_t i = 0; i < n; ++i)
            result[std::size_t(i)] = 0.25 * x[std::size_t(reflected(i - lag, n))] + 0.5 * x[std::size_t(i)]
                                     + 0.25 * x[std::size_t(reflected(i + lag, n))];
        return result;
    }

    /// Standard deviation of a scale's details for white noise of deviation 1: the root of the energy of the details of
    /// a unit impulse.
    const std::array<double, scales> &detailDeviations()
    {
        static const std::array<double, scales> deviations = [] {
            std::array<double, scales> result{};
            std::vector<double> impulse(std::size_t(4) << scales, 0.0);
            impulse[impulse.size() / 2] = 1.0;
            for (int scale = 0; scale < scales; ++scale) {
                const std::vector<double> coarse = smoothed(impulse, std::ptrdiff_t(1) << scale);
                for (std::size_t i = 0; i < impulse.size(); ++i)
                    result[std::size_t(scale)] += (impulse[i] - coarse[i]) * (impulse[i] - coarse[i]);
                impulse = coarse;
            }
            for (double &value : result)
                value = std::sqrt(value);
            return result;
        }();
        return deviations;
    }

    struct Sum {
        double sum = 0.0;
        double count = 0.0;
    };

    /// Of the values below a limit. In lanes, so that a value need not wait for the sum of those before it.
    template <int bytes>
    [[gnu::always_inline]] inline Sum sumBelowBy(std::span<const float> values, float limit)
    {
        constexpr std::size_t lanes = 16;
        constexpr std::size_t perPart = Vector<double, bytes>::lanes;
        constexpr std::size_t parts = lanes / perPart;
        using Floats = Vector<float, bytes / 2>;
        using Doubles = typename Vector<double, bytes>::Type;
        Doubles sums[parts]{};
        typename Vector<std::int32_t, bytes / 2>::Type counts[parts]{};
        const std::size_t whole = values.size() / lanes * lanes;
        for (std::size_t i = 0; i < whole; i += lanes)
#pragma GCC unroll 8
            for (std::size_t part = 0; part < parts; ++part) {
                const typename Floats::Type value =
                    *reinterpret_cast<const typename Floats::Unaligned *>(values.data() + i + part * perPart);
                counts[part] -= value < limit;
                sums[part] += __builtin_convertvector(value < limit ? value : typename Floats::Type{}, Doubles);
            }
        Sum all;
        for (const float value : values.subspan(whole))
            if (value < limit) {
                all.sum += double(value);
                all.count += 1.0;
            }
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            all.sum += sums[lane / perPart][lane % perPart];
            all.count += double(counts[lane / perPart][lane % perPart]);
        }
        return all;
    }

    Sum sumBelow(std::span<const float> values, float limit)
    {
        return withVectors([&](auto bytes) __attribute__((always_inline)) { return sumBelowBy<bytes>(values, limit); });
    }

    struct Split {
        std::int32_t below; ///< number of values
        float last;         ///< of these
        float next;         ///< least of the others
    };

    /// Splits values that are not negative, whose bits therefore have their order.
    template <int bytes>
    [[gnu::always_inline]] inline Split splitAtBy(std::span<const float> values, float limit)
    {
        using Bits = Vector<std::int32_t, bytes>;
        constexpr std::size_t lanes = Bits::lanes;
        constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
        const auto limitBits = std::bit_cast<std::int32_t>(limit);
        typename Bits::Type below{};
        typename Bits::Type last{};
        typename Bits::Type next = last + none;
        const std::size_t whole = values.size() / lanes * lanes;
        for (std::size_t i = 0; i < whole; i += lanes) {
            const typename Bits::Type bits = *reinterpret_cast<const typename Bits::Unaligned *>(values.data() + i);
            const typename Bits::Type lower = bits < limitBits ? bits : typename Bits::Type{};
            const typename Bits::Type upper = bits < limitBits ? typename Bits::Type{} + none : bits;
            below -= bits < limitBits;
            last = last < lower ? lower : last;
            next = upper < next ? upper : next;
        }
        std::int32_t count = 0, greatest = 0, least = none;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            count += below[lane];
            greatest = std::max(greatest, last[lane]);
            least = std::min(least, next[lane]);
        }
        for (const float value : values.subspan(whole)) {
            const auto bits = std::bit_cast<std::int32_t>(value);
            count += bits < limitBits ? 1 : 0;
            greatest = std::max(greatest, bits < limitBits ? bits : 0);
            least = std::min(least, bits < limitBits ? none : bits);
        }
        return {count, std::bit_cast<float>(greatest), std::bit_cast<float>(least)};
    }

    Split splitAt(std::span<const float> values, float limit)
    {
        return withVectors([&](auto bytes) __attribute__((always_inline)) { return splitAtBy<bytes>(values, limit); });
    }

    /// Cumulative sums of squares.
    std::vector<double> energyUpTo(const std::vector<double> &x)
    {
        std::vector<double> sums(x.size() + 1, 0.0);
        for (std::size_t i = 0; i < x.size(); ++i)
            sums[i + 1] = sums[i] + x[i] * x[i];
        return sums;
    }

} // namespace

float medianOf(std::vector<float> &values)
{
    const auto middle = values.begin() + std::ptrdiff_t((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

float exponentialMedian(std::span<const float> values, float expected)
{
    const auto rank = std::int32_t((values.size() - 1) / 2);
    // Shares of an exponential law with the expected median, 1 - 2^(-y/expected), between which the median lies, and
    // how many values lie below them: nearly in proportion, so that a few steps lead to it.
    double low = 0.0, high = 1.0;
    std::int32_t belowLow = 0, belowHigh = std::int32_t(values.size());
    for (int step = 0; step < 12; ++step) {
        const double share = low + (high - low) * (rank + 0.5 - belowLow) / (belowHigh - belowLow);
        const Split split = splitAt(values, float(-double(expected) * std::log2(1.0 - share)));
        if (split.below == rank)
            return split.next;
        if (split.below == rank + 1)
            return split.last;
        (split.below < rank ? low : high) = share;
        (split.below < rank ? belowLow : belowHigh) = split.below;
    }
    std::vector<float> copy(values.begin(), values.end()); // of another law: values that are equal, for instance
    return medianOf(copy);
}

double medianMean(int n)
{
    double mean = 0.0;
    for (int i = 0; i < (n + 1) / 2; ++i)
        mean += 1.0 / (n - i);
    return mean;
}

double medianScatter(double cells)
{
    return inverseLn2 * std::sqrt(cellsAlike / cells);
}

double meanScatter(double cells, double likeness)
{
    return std::sqrt(likeness / cells);
}

float truncatedMean(std::span<const float> cells, float guess)
{
    const float kept =
        (1.0f - (1.0f + lineLimit) * std::exp(-lineLimit)) / (1.0f - std::exp(-lineLimit)); // E[y | y < cut]
    for (int pass = 0; pass < 2; ++pass) {
        const auto [sum, count] = sumBelow(cells, lineLimit * guess);
        if (sum > 0.0)
            guess = float(sum / count) / kept;
    }
    return guess;
}

std::vector<float> beyondScatter(const std::vector<float> &series, double scatter)
{
    // Neighbours on either side, in steps of the scale, and the E/σ² that white noise hardly ever reaches with that
    // many: few neighbours detect short changes, many detect faint ones.
    struct NeighboursBeside {
        std::ptrdiff_t half;
        double chance;
    };
    constexpr std::array<NeighboursBeside, 2> neighbourhoods{{{1, 8.0}, {12, 1.8}}};
    const std::ptrdiff_t n = std::ssize(series);
    std::vector<double> rest(series.begin(), series.end());
    std::vector<double> kept(series.size(), 0.0);
    for (int scale = 0; scale < scales && (std::ptrdiff_t(2) << scale) <= n; ++scale) {
        const std::ptrdiff_t lag = std::ptrdiff_t(1) << scale;
        const std::vector<double> coarse = smoothed(rest, lag);
        for (std::size_t i = 0; i < rest.size(); ++i)
            rest[i] -= coarse[i];
        const std::vector<double> energy = energyUpTo(rest);
        const double deviation = scatter * detailDeviations()[std::size_t(scale)];
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            double factor = 0.0;
            for (const NeighboursBeside &near : neighbourhoods) {
                const std::ptrdiff_t from = std::max<std::ptrdiff_t>(0, i - near.half * lag);
                const std::ptrdiff_t to = std::min(n, i + near.half * lag + 1);
                const double mean = (energy[std::size_t(to)] - energy[std::size_t(from)]) / double(to - from);
                if (mean > near.chance * deviation * deviation)
                    factor = std::max(factor, 1.0 - deviation * deviation / mean);
            }
            kept[std::size_t(i)] += factor * rest[std::size_t(i)];
        }
        rest = coarse;
    }
    std::vector<float> result(series.size());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = float(kept[i] + rest[i]);
    return result;
}

float latestBeyondScatter(std::span<const float> series, double scatter)
{
    // As in beyondScatter, with all neighbours on one side; short changes are detected by the newest detail itself.
    struct NeighboursBefore {
        std::ptrdiff_t before;
        double chance;
    };
    constexpr std::array<NeighboursBefore, 2> neighbourhoods{{{0, 8.0}, {24, 1.8}}};
    const std::ptrdiff_t n = std::ssize(series);
    std::vector<double> rest(series.begin(), series.end());
    std::vector<double> detail(rest.size());
    double kept = 0.0;
    for (int scale = 0; scale < scales && (std::ptrdiff_t(2) << scale) <= n; ++scale) {
        const std::ptrdiff_t lag = std::ptrdiff_t(1) << scale;
        const std::ptrdiff_t first = 2 * lag - 1; // first value whose mean lies in the series
        for (std::ptrdiff_t i = n - 1; i >= first; --i) {
            const auto at = std::size_t(i);
            detail[at] = 0.5 * (rest[at] - rest[std::size_t(i - lag)]);
            rest[at] -= detail[at];
        }
        const double variance = scatter * scatter / double(2 * lag);
        double factor = 0.0;
        for (const NeighboursBefore &near : neighbourhoods) {
            const std::ptrdiff_t from = std::max(first, n - 1 - near.before * lag);
            double mean = 0.0;
            for (std::ptrdiff_t i = from; i < n; ++i)
                mean += detail[std::size_t(i)] * detail[std::size_t(i)];
            mean /= double(n - from);
            if (mean > near.chance * variance)
                factor = std::max(factor, 1.0 - variance / mean);
        }
        kept += factor * detail.back();
    }
    return float(kept + rest.back());
}

} // namespace faintline
