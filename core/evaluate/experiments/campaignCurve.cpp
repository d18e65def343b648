#include "evaluate/experiments/campaignCurve.h"

#include "evaluate/experiments/sweepCurve.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace faintline {

namespace {

    std::vector<CurvePoint> curveOfSweep(const Campaign &campaign, const SweepExperiment &sweep)
    {
        std::vector<CurvePoint> curve;
        for (const SweepPoint &point : sweepCurve(campaign))
            curve.push_back({sweep.parameter + " = " + formatNumber(point.value), sweep.snrDb, point.pd,
                             point.pdInterval, point.trials, point.threshold});
        return curve;
    }

    CurvePoint injectionPoint(const InjectionExperiment &experiment, const Campaign &campaign, std::size_t detector,
                              std::size_t snr)
    {
        const double threshold = campaign.thresholds[detector];
        CurvePoint point{experiment.detectors[detector].name, experiment.snrDb[snr], 0.0, {}, 0, threshold};
        std::int64_t detections = 0;
        for (const RunOutcome &outcome : campaign.outcomes) {
            ++point.trials;
            detections += double(outcome.signal[detector][snr].front()) > threshold ? 1 : 0;
        }
        point.pd = point.trials > 0 ? double(detections) / double(point.trials) : 0.0;
        point.interval = wilsonInterval(detections, point.trials);
        return point;
    }

    /// Each path without the line serves as threshold, the highest first.
    std::vector<RocPoint> injectionRoc(const Campaign &campaign, std::size_t detector, std::size_t snr)
    {
        std::vector<float> noise;
        std::vector<float> signal;
        for (const RunOutcome &outcome : campaign.outcomes) {
            noise.push_back(outcome.noise[detector].front());
            signal.push_back(outcome.signal[detector][snr].front());
        }
        std::ranges::sort(noise);
        std::ranges::sort(signal);
        const auto above = [](const std::vector<float> &values, float threshold) {
            return values.end() - std::ranges::upper_bound(values, threshold);
        };
        const auto trials = std::ssize(noise);
        std::vector<float> thresholds = noise;
        thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
        std::ranges::reverse(thresholds);
        std::vector<RocPoint> points;
        for (const float threshold : thresholds) {
            const auto detections = above(signal, threshold);
            points.push_back({double(threshold), double(above(noise, threshold)) / double(trials),
                              double(detections) / double(trials), wilsonInterval(detections, trials)});
        }
        return points;
    }

} // namespace

std::vector<RocPoint> rocPoints(const Campaign &campaign, std::size_t detector, std::size_t snr)
{
    if (campaign.outcomes.empty() || std::holds_alternative<SweepExperiment>(campaign.experiment))
        return {};
    if (const auto *lines = std::get_if<LineExperiment>(&campaign.experiment))
        return rocCurve(*lines, campaign.outcomes, detector, snr);
    return injectionRoc(campaign, detector, snr);
}

double shownThreshold(const Campaign &campaign, std::size_t detector)
{
    if (detectorsOf(campaign.experiment)[detector].isWhole)
        return 0.0; // of a margin
    const double share = 1.0 - std::exp(-1.0);
    return campaign.thresholds.empty() ? blockThreshold(campaign.outcomes, detector, share)
                                       : campaign.thresholds[detector];
}

std::vector<CurvePoint> pdCurve(const Campaign &campaign)
{
    std::vector<CurvePoint> curve;
    if (campaign.outcomes.empty())
        return curve;
    if (const auto *sweep = std::get_if<SweepExperiment>(&campaign.experiment))
        return curveOfSweep(campaign, *sweep);
    std::visit(
        [&]<class E>(const E &experiment) {
            if constexpr (!std::is_same_v<E, SweepExperiment>)
                for (std::size_t d = 0; d < experiment.detectors.size(); ++d) {
                    const double threshold = shownThreshold(campaign, d);
                    for (std::size_t s = 0; s < experiment.snrDb.size(); ++s) {
                        if constexpr (std::is_same_v<E, LineExperiment>) {
                            const PdPoint point = pdAgainstBlocks(experiment, campaign.outcomes, d, s);
                            curve.push_back({experiment.detectors[d].name, point.snrDb, point.pd, point.interval,
                                             point.trials, threshold});
                        } else {
                            curve.push_back(injectionPoint(experiment, campaign, d, s));
                        }
                    }
                }
        },
        campaign.experiment);
    return curve;
}

} // namespace faintline
