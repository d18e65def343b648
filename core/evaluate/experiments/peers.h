#pragma once

#include "evaluate/experiments/LineExperiment.h"

#include <string_view>
#include <vector>

namespace faintline {

/// The detectors that the sequential Markov detector is measured against, each as its source sets it up: Billon 2005
/// sections 2 and 5 (SMD with five slopes and with one, P out of N, integrator), one frame's energy, and Viterbi's
/// algorithm over a block without reset. Those that integrate over a fixed time are matched to lines of
/// `durationWindows` windows.
std::vector<DetectorUnderTest> peers(double durationWindows);

/// The one of that name. Throws Error naming all.
DetectorUnderTest peer(std::string_view name, double durationWindows);

} // namespace faintline
