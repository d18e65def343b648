#pragma once

#include "plan/Analysis.h"

#include <span>
#include <vector>

namespace faintline {

/// The band of ln K values, one per frame, from settled noise. Precondition: at least two.
NoiseBand noiseBand(std::span<const double> lnK);

/// Range of ln K of a regulating reset law on settled noise, by simulation on calibrationSubgrid, with the scatter
/// scaled to the whole. The deviation is 0 if the law regulates nothing.
NoiseBand regulationBand(const MarkovModel &model, const ResetRule &rule, const RunContext &context = {});

/// The frames in which ln K lies below its band, ascending: signals without a track lower it, and thereby the statistic
/// of all others. Above the band it is still settling. Empty if K is not regulated.
std::vector<Index> draggedFrames(const Analysis &analysis);

} // namespace faintline
