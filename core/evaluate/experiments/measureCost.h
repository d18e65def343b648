#pragma once

#include "base/RunContext.h"
#include "plan/Analysis.h"

namespace faintline {

/// Processor time of the analysis's chain (frames, detector, decision, trackers) per hour of recording, in seconds of
/// this machine on one thread: measured on its first frames for about a quarter of a second. Excludes calibration and
/// noise background, which are computed once. No result depends on it. It measures the time of the calling thread.
double measureCost(const Analysis &analysis, const RunContext &context = {});

} // namespace faintline
