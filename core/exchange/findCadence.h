#pragma once

#include "base/RunContext.h"
#include "exchange/TopHits.h"

#include <vector>

namespace faintline {

/// A signal that is present in all observations on target, and in none off target.
struct CadenceEvent {
    std::vector<TopHit> hits; ///< one for each observation on target
};

/// Finds such signals in a cadence: observations alternately on target (the first, third, fifth …) and off it.
///
/// A hit is the same signal as one of another observation if that lies on the straight line through it, extrapolated,
/// within two channels plus half a drift step of both per second between them, and their drifts agree within two drift
/// steps. Of several matches the strongest counts. An event is a hit of the first observation with a match in all
/// others on target and in none off it. `slackHz` widens the tolerance.
///
/// Throws Error if there are fewer than two observations, or one has no start time; Cancelled.
std::vector<CadenceEvent> findCadence(const std::vector<TopHits> &observations, double slackHz = 0.0,
                                      const RunContext &context = {});

/// CSV with one line per event: drift, frequency and SNR of each observation on target.
std::string cadenceCsv(const std::vector<CadenceEvent> &events);

} // namespace faintline
