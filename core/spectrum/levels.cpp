#include "spectrum/levels.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double likeness = 1.5; // so many neighbouring cells tell as much as one

    /// Variance of the differences x(i + lag) - x(i), from their median magnitude: steps and clicks do not count.
    double differenceVariance(const std::vector<float> &x, std::size_t lag)
    {
        std::vector<float> magnitudes;
        for (std::size_t i = lag; i < x.size(); ++i)
            magnitudes.push_back(std::abs(x[i] - x[i - lag]));
        const double deviation = 1.4826 * static_cast<double>(medianOf(magnitudes));
        return deviation * deviation;
    }

} // namespace

float medianOf(std::vector<float> &values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double medianMean(int n)
{
    double mean = 0.0;
    for (int i = 0; i < (n + 1) / 2; ++i)
        mean += 1.0 / (n - i);
    return mean;
}

double lnMedianMean(std::ptrdiff_t n)
{
    return std::log(medianMean(static_cast<int>(n))) - 0.5 * 1.44 * 1.44 * likeness / static_cast<double>(n);
}

double medianScatter(double cells)
{
    return 1.44 * std::sqrt(likeness / cells);
}

float truncatedMean(std::span<const float> cells, float guess)
{
    constexpr float cut = 5.0f;
    const float kept = (1.0f - (1.0f + cut) * std::exp(-cut)) / (1.0f - std::exp(-cut)); // E[y | y < cut]
    for (int pass = 0; pass < 2; ++pass) {
        double sum = 0.0;
        double count = 0.0;
        for (float value : cells)
            if (value < cut * guess) {
                sum += static_cast<double>(value);
                count += 1.0;
            }
        if (sum > 0.0)
            guess = static_cast<float>(sum / count) / kept;
    }
    return guess;
}

std::vector<float> slowPart(const std::vector<float> &series)
{
    constexpr std::size_t lag = 16;
    std::vector<float> smooth(series.size(), 0.0f);
    if (series.size() < 4 * lag)
        return smooth;
    const double near = differenceVariance(series, 1);
    const double far = differenceVariance(series, lag);
    const double scatter = 4.0 / std::sqrt(static_cast<double>(series.size())); // of far/near in white noise
    if (far <= near * (1.0 + 2.0 * scatter))
        return smooth;
    const double walk = (far - near) / (lag - 1.0);
    const double noise = std::max(0.5 * (near - walk), 1e-3 * walk);
    const double ratio = walk / noise;
    const double gain = 0.5 * (std::sqrt(ratio * ratio + 4.0 * ratio) - ratio);
    const double largest = 3.0 * std::sqrt(noise / (1.0 - gain));
    std::vector<float> beginning(series.begin(), series.begin() + lag / 2);
    double level = static_cast<double>(medianOf(beginning));
    for (std::size_t i = 0; i < series.size(); ++i) {
        level += gain * std::clamp(static_cast<double>(series[i]) - level, -largest, largest);
        smooth[i] = static_cast<float>(level);
    }
    for (std::size_t i = series.size() - 1; i-- > 0;)
        smooth[i] += static_cast<float>(1.0 - gain) * (smooth[i + 1] - smooth[i]);
    return smooth;
}

std::vector<float> suddenPart(const std::vector<float> &series, double scatter, double certainty)
{
    constexpr std::ptrdiff_t half = 3;
    const double medianOfSeven = scatter * 1.25 / std::sqrt(2.0 * half + 1.0);
    const std::ptrdiff_t n = std::ssize(series);
    std::vector<float> result(series.size());
    std::vector<float> few;
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        few.assign(series.begin() + std::max<std::ptrdiff_t>(0, i - half), series.begin() + std::min(n, i + half + 1));
        const auto level = static_cast<double>(medianOf(few));
        result[static_cast<std::size_t>(i)] = static_cast<float>(level * std::clamp(std::abs(level) / medianOfSeven - certainty, 0.0, 1.0));
    }
    return result;
}

} // namespace faintline
