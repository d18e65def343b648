#pragma once

#include "analysis/analyse.h"

namespace faintline {

/// Processor time that the analysis's chain (frames, detector, decision, trackers) takes for an hour of recording, in
/// seconds of this machine on one thread: measured on its first frames, for about a quarter of a second. Calibration
/// and noise background, which are made once, do not count. No result depends on it. Thread rule: the time is that of
/// the calling thread.
double measureCost(const Analysis &analysis, const RunContext &context = {});

} // namespace faintline
