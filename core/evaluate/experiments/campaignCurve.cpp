#include "evaluate/experiments/campaignCurve.h"

#include "evaluate/experiments/PdCurve.h"
#include "evaluate/experiments/sweepCurve.h"

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

} // namespace

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
                for (std::size_t d = 0; d < experiment.detectors.size(); ++d)
                    for (std::size_t s = 0; s < experiment.snrDb.size(); ++s) {
                        if constexpr (std::is_same_v<E, LineExperiment>) {
                            const PdPoint point = pdAgainstBlocks(experiment, campaign.outcomes, d, s);
                            curve.push_back({experiment.detectors[d].name,
                                             point.snrDb,
                                             point.pd,
                                             point.interval,
                                             point.trials,
                                             {}});
                        } else {
                            curve.push_back(injectionPoint(experiment, campaign, d, s));
                        }
                    }
        },
        campaign.experiment);
    return curve;
}

} // namespace faintline
