#include "evaluate/experiments/PdCurve.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr std::size_t runsForScatter = 5;

    std::vector<float> pooledNoise(std::span<const RunOutcome> outcomes, std::size_t detector)
    {
        std::vector<float> maxima;
        for (const RunOutcome &outcome : outcomes)
            maxima.insert(maxima.end(), outcome.noise[detector].begin(), outcome.noise[detector].end());
        std::sort(maxima.begin(), maxima.end());
        return maxima;
    }

    std::vector<float> pooledSignal(std::span<const RunOutcome> outcomes, std::size_t detector, std::size_t snr)
    {
        std::vector<float> maxima;
        for (const RunOutcome &outcome : outcomes)
            maxima.insert(maxima.end(), outcome.signal[detector][snr].begin(), outcome.signal[detector][snr].end());
        std::sort(maxima.begin(), maxima.end());
        return maxima;
    }

    std::int64_t countAbove(const std::vector<float> &ascending, double threshold)
    {
        const auto first = std::upper_bound(ascending.begin(), ascending.end(), threshold,
                                            [](double t, float value) { return t < double(value); });
        return ascending.end() - first;
    }

    PdPoint pdOf(const std::vector<float> &ascending, double snrDb, double threshold)
    {
        const std::int64_t wins = countAbove(ascending, threshold);
        const std::int64_t trials = std::ssize(ascending);
        return {snrDb, double(wins) / double(trials), wilsonInterval(wins, trials), trials};
    }

} // namespace

PdPoint pdAgainstBlocks(const LineExperiment &experiment, std::span<const RunOutcome> outcomes, std::size_t detector,
                        std::size_t snr)
{
    PdPoint point;
    point.snrDb = experiment.snrDb[snr];
    double sum = 0.0;
    double sumOfSquares = 0.0;
    for (const RunOutcome &outcome : outcomes) {
        const std::vector<float> &signals = outcome.signal[detector][snr];
        const std::vector<float> &blocks = outcome.noise[detector];
        std::int64_t wins = 0;
        for (const float d1 : signals)
            wins += std::count_if(blocks.begin(), blocks.end(), [d1](float d0) { return d1 > d0; });
        const double pd = double(wins) / double(signals.size() * blocks.size());
        sum += pd;
        sumOfSquares += pd * pd;
        point.trials += std::ssize(signals);
    }
    const auto runs = double(outcomes.size());
    point.pd = sum / runs;
    if (outcomes.size() < runsForScatter) {
        point.interval = wilsonInterval(std::llround(point.pd * double(point.trials)), point.trials);
        return point;
    }
    const double variance = std::max(0.0, sumOfSquares / runs - point.pd * point.pd) / (runs - 1.0);
    point.interval = normalInterval(point.pd, std::sqrt(variance));
    point.interval = {std::max(0.0, point.interval.low), std::min(1.0, point.interval.high)};
    return point;
}

double blockThreshold(std::span<const RunOutcome> outcomes, std::size_t detector, double probability)
{
    const std::vector<float> maxima = pooledNoise(outcomes, detector);
    const double position = (1.0 - probability) * double(maxima.size());
    const auto index = std::clamp<std::ptrdiff_t>(std::ptrdiff_t(std::ceil(position)) - 1, 0, std::ssize(maxima) - 1);
    return double(maxima[std::size_t(index)]);
}

std::vector<RocPoint> rocCurve(const LineExperiment &experiment, std::span<const RunOutcome> outcomes,
                               std::size_t detector, std::size_t snr)
{
    std::vector<float> thresholds = pooledNoise(outcomes, detector);
    const auto blocks = double(thresholds.size());
    const std::vector<float> maxima = thresholds;
    thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
    std::reverse(thresholds.begin(), thresholds.end());
    const std::vector<float> signals = pooledSignal(outcomes, detector, snr);
    std::vector<RocPoint> curve;
    for (const float threshold : thresholds) {
        const auto above = double(countAbove(maxima, double(threshold)));
        const PdPoint pd = pdOf(signals, experiment.snrDb[snr], double(threshold));
        curve.push_back({double(threshold), -std::log1p(-above / blocks), pd.pd, pd.interval});
    }
    return curve;
}

} // namespace faintline
