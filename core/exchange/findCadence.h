#pragma once

#include "base/RunContext.h"
#include "exchange/TopHits.h"

#include <vector>

namespace faintline {

/// A signal that is there whenever the telescope points at the target, and never when it does not.
struct CadenceEvent {
    std::vector<TopHit> hits; ///< one of each observation on target
};

/// Finds them in a cadence: observations in turn on target (the first, third, fifth …) and off it.
///
/// A hit is the same signal as one of another observation if that lies on the straight line through it, extrapolated,
/// within two channels and half a drift step of both for every second between them, and its drift agrees within two
/// drift steps. Of several the strongest counts. An event is a hit of the first observation with one of the same signal
/// in all others on target and in none off it. `slackHz` more is allowed.
///
/// Throws Error where there are fewer than two observations, or one has no start time; Cancelled.
std::vector<CadenceEvent> findCadence(const std::vector<TopHits> &observations, double slackHz = 0.0,
                                      const RunContext &context = {});

/// CSV: a line an event, drift, frequency and SNR of each observation on target.
std::string cadenceCsv(const std::vector<CadenceEvent> &events);

} // namespace faintline
