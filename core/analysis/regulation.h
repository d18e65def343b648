#pragma once

#include "analysis/Analysis.h"
#include "detect/NoiseBand.h"

#include <vector>

namespace faintline {

/// Where ln K of a regulating reset law stays on settled noise: found by simulation on a handy piece of the grid, the
/// scatter scaled to the whole. Of deviation 0 where the law regulates nothing.
NoiseBand regulationBand(const MarkovModel &model, const ResetRule &rule, const RunContext &context = {});

/// The frames in which ln K lies below its band, ascending: signals without a track lower it, and the statistic of all
/// others with it. Above the band it is still settling. Empty where K is not regulated.
std::vector<Index> draggedFrames(const Analysis &analysis);

} // namespace faintline
