#include "track/RivalModels.h"

#include "track/constants.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    std::map<int, std::vector<HmmTracker>> copyOf(const std::map<int, std::vector<HmmTracker>> &rivals,
                                                  std::span<const std::unique_ptr<TrackerModel>> models)
    {
        std::map<int, std::vector<HmmTracker>> result;
        for (const auto &[track, trackers] : rivals)
            for (const HmmTracker &tracker : trackers)
                result[track].push_back(tracker.withoutPast(*models[tracker.model()]));
        return result;
    }

} // namespace

bool RivalModels::update(HmmTracker &tracker, bool goesOn, Index frame, std::span<const float> lambda,
                         std::span<const double> lnK)
{
    if (m_models.size() < 2)
        return goesOn;
    std::vector<HmmTracker> &rivals = m_rivals[tracker.track().id];
    std::erase_if(rivals, [&](HmmTracker &rival) { return !rival.update(frame, lambda, lnK[rival.model()]); });
    const auto best = std::max_element(rivals.begin(), rivals.end(), [](const HmmTracker &a, const HmmTracker &b) {
        return a.statistic() < b.statistic();
    });
    if (best != rivals.end() && (best->statistic() > tracker.statistic() || !goesOn)) {
        tracker.changeTo(std::move(*best));
        rivals.clear();
        goesOn = true;
    }
    if (!goesOn)
        return false;
    std::erase_if(rivals, [frame](const HmmTracker &rival) {
        return frame - rival.track().modelChanges.back().frame >= rivalFrames;
    });
    for (std::size_t model = 0; model < m_models.size(); ++model)
        if (model != tracker.model())
            rivals.push_back(tracker.changedTo(*m_models[model], model, std::log(changeProbability)));
    return true;
}

void RivalModels::keepOnly(std::span<const HmmTracker> trackers)
{
    std::erase_if(m_rivals, [&](const auto &rivals) {
        return std::none_of(trackers.begin(), trackers.end(),
                            [&](const HmmTracker &tracker) { return tracker.track().id == rivals.first; });
    });
}

std::map<int, std::vector<HmmTracker>> RivalModels::state() const
{
    return copyOf(m_rivals, m_models);
}

void RivalModels::setState(const std::map<int, std::vector<HmmTracker>> &state)
{
    m_rivals = copyOf(state, m_models);
}

} // namespace faintline
