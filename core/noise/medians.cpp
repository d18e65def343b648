#include "noise/medians.h"

#include "base/multiversion.h"
#include "noise/constants.h"
#include "noise/levels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace faintline {

namespace {

    constexpr std::size_t lanes = 32; ///< columns processed at a time, in a few registers

    /// The value of a rank in each of `lanes` columns, found bit by bit: the bits of non-negative floats have the order
    /// of the floats.
    template <int bytes>
    [[gnu::always_inline]] inline void rankedBy(const float *columns, std::size_t rows, std::int32_t rank, float *out)
    {
        using Bits = typename Vector<std::int32_t, bytes>::Type;
        using UnalignedBits = typename Vector<std::int32_t, bytes>::Unaligned;
        constexpr std::size_t parts = lanes / Vector<std::int32_t, bytes>::lanes;
        Bits found[parts]{};
        for (std::int32_t bit = 1 << 30; bit > 0; bit >>= 1) {
            Bits smaller[parts]{};
            for (std::size_t row = 0; row < rows; ++row) {
                const auto *values = reinterpret_cast<const UnalignedBits *>(columns + row * lanes);
#pragma GCC unroll 8
                for (std::size_t part = 0; part < parts; ++part)
                    smaller[part] -= values[part] < (found[part] | bit);
            }
#pragma GCC unroll 8
            for (std::size_t part = 0; part < parts; ++part)
                found[part] = smaller[part] <= rank ? found[part] | bit : found[part];
        }
#pragma GCC unroll 8
        for (std::size_t part = 0; part < parts; ++part)
            reinterpret_cast<UnalignedBits *>(out)[part] = found[part];
    }

    void ranked(const float *columns, std::size_t rows, std::int32_t rank, float *out)
    {
        withVectors([&](auto bytes) __attribute__((always_inline)) { rankedBy<bytes>(columns, rows, rank, out); });
    }

    /// By their bits, whose maximum the compiler vectorises.
    FAINTLINE_MULTIVERSION
    std::int32_t largestBits(const float *values, std::size_t size)
    {
        std::int32_t most = 0;
        for (std::size_t i = 0; i < size; ++i)
            most = std::max(most, std::bit_cast<std::int32_t>(values[i]));
        return most;
    }

} // namespace

float largest(std::span<const float> values)
{
    return std::bit_cast<float>(largestBits(values.data(), values.size()));
}

void columnMedians(std::span<const float> frames, std::span<float> out)
{
    const std::size_t cells = out.size();
    const std::size_t rows = frames.size() / cells;
    const auto rank = std::int32_t((rows - 1) / 2);
    // A contiguous copy of some columns, because rows at a power-of-two distance would evict one another from the
    // cache; of several registers full at once, so that of each row whole stretches are read.
    constexpr std::size_t together = 8 * lanes;
    std::vector<float> columns(rows * together, 0.0f);
    std::array<float, lanes> medians;
    for (std::size_t first = 0; first < cells; first += together) {
        const std::size_t end = std::min(cells, first + together);
        for (std::size_t row = 0; row < rows; ++row)
            for (std::size_t cell = first; cell < end; cell += lanes)
                std::copy_n(frames.data() + row * cells + cell, std::min(lanes, end - cell),
                            columns.data() + (cell - first) * rows + row * lanes);
        for (std::size_t cell = first; cell < end; cell += lanes) {
            ranked(columns.data() + (cell - first) * rows, rows, rank, medians.data());
            std::copy_n(medians.begin(), std::min(lanes, end - cell), out.begin() + std::ptrdiff_t(cell));
        }
    }
}

std::vector<float> runningMedian(const std::vector<float> &sequence, Index half)
{
    const Index n = std::ssize(sequence);
    half = std::min(half, n - 1);
    const auto pivot = [&](Index from) {
        std::vector<float> few;
        for (Index i = from; i < std::min(from + pivotCells, n); ++i)
            few.push_back(sequence[std::size_t(i)]);
        return medianOf(few);
    };
    const float low = pivot(0);
    const float high = pivot(std::max<Index>(0, n - pivotCells));
    const Index centre = (std::min(pivotCells, n) - 1) / 2; // for a slope, the pivot's value is that of its middle
    const auto at = [&](Index i) {
        if (i < 0)
            return 2.0f * low - sequence[std::size_t(std::min(2 * centre - i, n - 1))];
        if (i >= n)
            return 2.0f * high - sequence[std::size_t(std::max<Index>(0, 2 * (n - 1 - centre) - i))];
        return sequence[std::size_t(i)];
    };
    // A sorted window, with one value inserted and one removed per step.
    std::vector<float> window;
    for (Index i = -half; i <= half; ++i)
        window.push_back(at(i));
    std::sort(window.begin(), window.end());
    std::vector<float> medians(sequence.size());
    for (Index i = 0; i < n; ++i) {
        medians[std::size_t(i)] = window[std::size_t(half)];
        const auto leaving = std::lower_bound(window.begin(), window.end(), at(i - half));
        window.erase(leaving);
        const float entering = at(i + half + 1);
        window.insert(std::upper_bound(window.begin(), window.end(), entering), entering);
    }
    return medians;
}

void runningMean(std::span<const double> values, std::span<const double> weights, Index half, std::span<double> out,
                 double least)
{
    const std::size_t n = values.size();
    std::vector<double> sum(n + 1, 0.0);
    std::vector<double> weight(n + 1, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        sum[i + 1] = sum[i] + weights[i] * values[i];
        weight[i + 1] = weight[i] + weights[i];
    }
    const auto reach = std::size_t(half);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t from = i < reach ? 0 : i - reach;
        const std::size_t to = std::min(n, i + reach + 1);
        const double total = weight[to] - weight[from];
        out[i] = total >= least ? (sum[to] - sum[from]) / total : 1.0;
    }
}

} // namespace faintline
