#include "refine/signalKind.h"

#include "refine/constants.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    bool isSpread(const Track &track, const AnalysisPlan &plan)
    {
        if (track.windowSeconds > 0.0 || !plan.settings.family.isNone()
            || plan.model.space.axes().front().rateChange.front() < slowLawProbability
            || track.peakStatistic < plan.sureStatistic())
            return false;
        const std::vector<std::size_t> present = track.presentPoints();
        const auto count = double(present.size());
        double level = 0.0;
        double bins = 0.0;
        for (const std::size_t i : present) {
            level += double(track.smoothed[i].level) / count;
            bins += double(track.smoothed[i].high - track.smoothed[i].low) / count;
        }
        const double limit = lineBandCells * std::max(1.0, 1.0 / std::sqrt(std::max(level, 1e-9)));
        return level < strongLevelRatio && bins > limit * plan.frames->geometry().binsPerCell;
    }

    int pausesOf(const Track &track, const AnalysisPlan &plan)
    {
        const auto isPause = [&](std::size_t i) {
            return !track.isPresent(i) && plan.frames->isObserved(track.points[i].frame);
        };
        int pauses = 0;
        for (std::size_t i = 1; i + 1 < track.points.size(); ++i)
            pauses += track.isPresent(i - 1) && isPause(i) ? 1 : 0;
        return pauses;
    }

} // namespace

std::string nameOf(SignalKind kind)
{
    switch (kind) {
    case SignalKind::Line:
        return "line";
    case SignalKind::Keyed:
        return "keyed";
    case SignalKind::Spread:
        return "spread";
    case SignalKind::Unknown:
        break;
    }
    return {};
}

SignalKind kindOf(const Track &track, const AnalysisPlan &plan)
{
    constexpr int fewestPauses = 2;
    if (!track.hasSecondPass())
        return SignalKind::Unknown;
    if (isSpread(track, plan))
        return SignalKind::Spread;
    return pausesOf(track, plan) >= fewestPauses ? SignalKind::Keyed : SignalKind::Line;
}

} // namespace faintline
