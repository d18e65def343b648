#include "spectrum/medians.h"

#include "spectrum/levels.h"

#include <algorithm>

namespace faintline {

void columnMedians(std::span<const float> frames, std::span<float> out)
{
    std::vector<float> column(frames.size() / out.size());
    for (std::size_t cell = 0; cell < out.size(); ++cell) {
        for (std::size_t row = 0; row < column.size(); ++row)
            column[row] = frames[row * out.size() + cell];
        out[cell] = medianOf(column);
    }
}

std::vector<float> runningMedian(const std::vector<float> &sequence, Index half)
{
    const Index n = std::ssize(sequence);
    half = std::min(half, n - 1);
    const auto pivot = [&](Index from) {
        std::vector<float> few;
        for (Index i = from; i < std::min(from + pivotCells, n); ++i)
            few.push_back(sequence[static_cast<std::size_t>(i)]);
        return medianOf(few);
    };
    const float low = pivot(0);
    const float high = pivot(std::max<Index>(0, n - pivotCells));
    const auto at = [&](Index i) {
        if (i < 0)
            return 2.0f * low - sequence[static_cast<std::size_t>(std::min(-i, n - 1))];
        if (i >= n)
            return 2.0f * high - sequence[static_cast<std::size_t>(std::max<Index>(0, 2 * (n - 1) - i))];
        return sequence[static_cast<std::size_t>(i)];
    };
    // A sorted window that one value enters and one leaves.
    std::vector<float> window;
    for (Index i = -half; i <= half; ++i)
        window.push_back(at(i));
    std::sort(window.begin(), window.end());
    std::vector<float> medians(sequence.size());
    for (Index i = 0; i < n; ++i) {
        medians[static_cast<std::size_t>(i)] = window[static_cast<std::size_t>(half)];
        const auto leaving = std::lower_bound(window.begin(), window.end(), at(i - half));
        window.erase(leaving);
        const float entering = at(i + half + 1);
        window.insert(std::upper_bound(window.begin(), window.end(), entering), entering);
    }
    return medians;
}

void runningMean(std::span<const double> values, std::span<const double> weights, Index half, std::span<double> out, double least)
{
    const std::size_t n = values.size();
    std::vector<double> sum(n + 1, 0.0);
    std::vector<double> weight(n + 1, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        sum[i + 1] = sum[i] + weights[i] * values[i];
        weight[i + 1] = weight[i] + weights[i];
    }
    const auto reach = static_cast<std::size_t>(half);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t from = i < reach ? 0 : i - reach;
        const std::size_t to = std::min(n, i + reach + 1);
        const double total = weight[to] - weight[from];
        out[i] = total >= least ? (sum[to] - sum[from]) / total : 1.0;
    }
}

} // namespace faintline
