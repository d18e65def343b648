#pragma once

#include "evaluate/experiments/Experiment.h"

#include <string_view>
#include <vector>

namespace faintline {

/// The detectors with which the sequential Markov detector is compared, each set up as in its source: Billon 2005
/// sections 2 and 5 (SMD with five slopes and with one, P out of N, integrator), the energy of one frame, and Viterbi's
/// algorithm over a block without reset. Detectors that integrate over a fixed time are matched to lines of
/// `durationWindows` windows.
std::vector<DetectorUnderTest> peers(double durationWindows);

/// The peer of that name. Throws Error listing all names.
DetectorUnderTest peer(std::string_view name, double durationWindows);

} // namespace faintline
