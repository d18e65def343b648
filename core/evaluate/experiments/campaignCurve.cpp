#include "evaluate/experiments/campaignCurve.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr std::size_t runsForScatter = 5;

    /// The values listOf(outcome) of all runs.
    template <class ListOf>
    std::vector<float> pooled(std::span<const RunOutcome> outcomes, ListOf listOf)
    {
        std::vector<float> values;
        for (const RunOutcome &outcome : outcomes)
            values.insert(values.end(), listOf(outcome).begin(), listOf(outcome).end());
        return values;
    }

    std::vector<float> pooledNoise(std::span<const RunOutcome> outcomes, std::size_t detector)
    {
        auto maxima = pooled(
            outcomes, [&](const RunOutcome &one) -> const auto & { return one.noise[detector]; });
        std::ranges::sort(maxima);
        return maxima;
    }

    std::vector<float> pooledSignals(std::span<const RunOutcome> outcomes, std::size_t detector, std::size_t snr)
    {
        return pooled(
            outcomes, [&](const RunOutcome &one) -> const auto & { return one.signal[detector][snr]; });
    }

    std::int64_t countAbove(const std::vector<float> &ascending, float threshold)
    {
        return ascending.end() - std::ranges::upper_bound(ascending, threshold);
    }

} // namespace

std::vector<CurvePoint> pdCurve(const Campaign &campaign)
{
    std::vector<CurvePoint> curve;
    if (campaign.outcomes.empty())
        return curve;
    const Experiment &experiment = campaign.experiment;
    if (experiment.isSweep()) {
        for (const SweepPoint &point : sweepCurve(campaign))
            curve.push_back({experiment.parameter + " = " + formatNumber(point.value), experiment.snrDb.front(),
                             point.pd, point.pdInterval, point.trials, point.threshold});
        return curve;
    }
    for (std::size_t d = 0; d < experiment.detectors.size(); ++d) {
        const double threshold = shownThreshold(campaign, d);
        for (std::size_t s = 0; s < experiment.snrDb.size(); ++s) {
            curve.push_back(experiment.isLines() ? pdAgainstBlocks(experiment, campaign.outcomes, d, s)
                                                 : pdAbove(campaign, d, s, threshold));
            curve.back().detector = experiment.detectors[d].name;
            curve.back().threshold = threshold;
        }
    }
    return curve;
}

CurvePoint pdAgainstBlocks(const Experiment &experiment, std::span<const RunOutcome> outcomes, std::size_t detector,
                           std::size_t snr)
{
    CurvePoint point;
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

CurvePoint pdAbove(const Campaign &campaign, std::size_t detector, std::size_t snr, double threshold)
{
    const std::vector<float> signals = pooledSignals(campaign.outcomes, detector, snr);
    const auto wins = std::ranges::count_if(signals, [&](float value) { return double(value) > threshold; });
    const std::int64_t trials = std::ssize(signals);
    const double snrDb = campaign.experiment.snrDb[snr];
    return {{}, snrDb, double(wins) / double(trials), wilsonInterval(wins, trials), trials, threshold};
}

double blockThreshold(std::span<const RunOutcome> outcomes, std::size_t detector, double probability)
{
    const std::vector<float> maxima = pooledNoise(outcomes, detector);
    const double position = (1.0 - probability) * double(maxima.size());
    const auto index = std::clamp<std::ptrdiff_t>(std::ptrdiff_t(std::ceil(position)) - 1, 0, std::ssize(maxima) - 1);
    return double(maxima[std::size_t(index)]);
}

double shownThreshold(const Campaign &campaign, std::size_t detector)
{
    if (campaign.experiment.detectors[detector].isWhole)
        return 0.0; // of a margin
    const double share = 1.0 - std::exp(-1.0);
    return campaign.thresholds.empty() ? blockThreshold(campaign.outcomes, detector, share)
                                       : campaign.thresholds[detector];
}

std::vector<RocPoint> rocPoints(const Campaign &campaign, std::size_t detector, std::size_t snr)
{
    if (campaign.outcomes.empty() || campaign.experiment.isSweep())
        return {};
    const bool isInBlocks = campaign.experiment.isLines();
    const std::vector<float> noise = pooledNoise(campaign.outcomes, detector);
    std::vector<float> signals = pooledSignals(campaign.outcomes, detector, snr);
    std::ranges::sort(signals);
    std::vector<float> thresholds = noise;
    thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
    std::ranges::reverse(thresholds);
    std::vector<RocPoint> curve;
    for (const float threshold : thresholds) {
        const double share = double(countAbove(noise, threshold)) / double(noise.size());
        const std::int64_t wins = countAbove(signals, threshold);
        curve.push_back({double(threshold), isInBlocks ? -std::log1p(-share) : share,
                         double(wins) / double(signals.size()), wilsonInterval(wins, std::ssize(signals))});
    }
    return curve;
}

std::vector<SweepPoint> sweepCurve(const Campaign &campaign)
{
    const auto &experiment = campaign.experiment;
    std::vector<SweepPoint> curve(experiment.values.size());
    std::vector<double> sum(curve.size()), sumOfSquares(curve.size());
    for (const RunOutcome &outcome : campaign.outcomes) {
        const auto i = std::size_t(experiment.valueOf(outcome.run));
        SweepPoint &point = curve[i];
        const auto latency = double(outcome.signal[0][0][0]);
        ++point.trials;
        point.falseAlarms += std::llround(outcome.noise[0][0]);
        point.hours += double(outcome.noise[0][1]) / 3600.0;
        if (!(latency >= 0.0))
            continue;
        ++point.detections;
        sum[i] += latency;
        sumOfSquares[i] += latency * latency;
    }
    for (std::size_t i = 0; i < curve.size(); ++i) {
        SweepPoint &point = curve[i];
        if (point.trials == 0)
            continue;
        point.value = experiment.values[i];
        point.threshold = i < campaign.thresholds.size() ? campaign.thresholds[i] : 0.0;
        point.pd = double(point.detections) / double(point.trials);
        point.pdInterval = wilsonInterval(point.detections, point.trials);
        const Interval counts = poissonInterval(point.falseAlarms);
        point.falseAlarmsPerHour = double(point.falseAlarms) / point.hours;
        point.falseAlarmInterval = {counts.low / point.hours, counts.high / point.hours};
        if (point.detections == 0)
            continue;
        const auto n = double(point.detections);
        point.latencySeconds = sum[i] / n;
        const double squares = std::max(0.0, sumOfSquares[i] - n * point.latencySeconds * point.latencySeconds);
        const double variance = n > 1.0 ? squares / (n - 1.0) : 0.0;
        point.latencyInterval = normalInterval(point.latencySeconds, std::sqrt(variance / n));
    }
    std::erase_if(curve, [](const SweepPoint &point) { return point.trials == 0; });
    return curve;
}

} // namespace faintline
