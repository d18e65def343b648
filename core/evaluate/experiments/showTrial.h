#pragma once

#include "analysis/analyse.h"
#include "evaluate/experiments/Campaign.h"
#include "evaluate/experiments/InjectionTrials.h"
#include "recording/Truth.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace faintline {

/// One trial of a campaign: a signal of a run, or the one line of an injection's trial (signal 0).
struct TrialPlace {
    int run = 0;
    int signal = 0;

    bool operator==(const TrialPlace &) const = default;
};

/// A point of a campaign's curves: which detector, at which of the experiment's SNRs.
struct CampaignPoint {
    std::size_t detector = 0;
    std::size_t snr = 0;
};

/// The trials behind a point of a campaign's curve, in order, and whether the campaign's statistic exceeds the
/// threshold shown.
struct TrialOutcome {
    TrialPlace place;
    double statistic = 0.0;
    bool isDetected = false;
};
std::vector<TrialOutcome> trialsOf(const Campaign &campaign, const CampaignPoint &point);

/// A trial made again and put through the whole chain, to be looked at.
struct ShownTrial {
    std::shared_ptr<const Analysis> analysis;
    Truth truth;
};

/// Makes the very trial behind a point again, with the detector's settings, the campaign's own ln K and the threshold
/// of `shownThreshold`. A simulated line comes with its block alone, one window T_FT a second long, one resolution cell
/// a hertz wide; an injected one in the whole selection. `trials`: of an injection, as prepared; null otherwise. Throws
/// Error, Cancelled.
ShownTrial showTrial(const Campaign &campaign, const InjectionTrials *trials, const CampaignPoint &point,
                     const TrialPlace &place, const RunContext &context = {});

} // namespace faintline
