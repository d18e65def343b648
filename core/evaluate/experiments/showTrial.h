#pragma once

#include "base/RunContext.h"
#include "evaluate/experiments/Campaign.h"
#include "plan/Analysis.h"
#include "scene/Truth.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace faintline {

/// One trial of a campaign: a signal of a run, or the only line of an injection trial (signal 0).
struct TrialPlace {
    int run = 0;
    int signal = 0;

    bool operator==(const TrialPlace &) const = default;
};

/// A point of a campaign's curves: a detector and one of the experiment's SNRs.
struct CampaignPoint {
    std::size_t detector = 0;
    std::size_t snr = 0;
};

/// A trial of a point, and whether the campaign's statistic exceeds the displayed threshold.
struct TrialOutcome {
    TrialPlace place;
    double statistic = 0.0;
    bool isDetected = false;
};
/// Nothing for a sweep.
std::vector<TrialOutcome> trialsOf(const Campaign &campaign, const CampaignPoint &point);

/// A regenerated trial after the whole chain, for display.
struct ShownTrial {
    std::shared_ptr<const Analysis> analysis;
    Truth truth;
};

/// Regenerates the trial behind a point, with the detector's settings, the campaign's own ln K and the threshold of
/// `shownThreshold`. A simulated line comes with its block only, with a window T_FT of one second and a resolution cell
/// of one hertz; an injected one with the whole selection. `trials`: those of the campaign, which an injection requires.
/// Throws Error, Cancelled.
ShownTrial showTrial(const Campaign &campaign, const Trials *trials, const CampaignPoint &point,
                     const TrialPlace &place, const RunContext &context = {});

} // namespace faintline
