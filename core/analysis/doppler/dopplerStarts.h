#pragma once

#include "analysis/doppler/DopplerPass.h"

#include <vector>

namespace faintline {

/// Passes from which a fit of these points may begin: the `most` best, and the best of those that are heard before and
/// after the points. The best comes first.
///
/// A grid over v, R/v and the time at which the closest approach is heard; f0 of each is the median of measured
/// frequency over f/f0. They are ranked by Σ |measured - fitted|/deviation, which a few outliers do not move. v begins
/// where the pass spans just what the points span (5 to 95 %). At most 60 points are looked at, evenly spread.
/// Precondition: times increase, frequencies above 0.
std::vector<DopplerPass> dopplerStarts(const std::vector<DopplerPoint> &points, double propagation, std::size_t most);

/// Passes long before and long after the points, at speeds up to 0.9 c: what a constant frequency may come from.
std::vector<DopplerPass> passesElsewhere(const std::vector<DopplerPoint> &points, double propagation);

/// Σ |measured - fitted|/deviation.
double absoluteMisfit(const std::vector<DopplerPoint> &points, double propagation, const DopplerPass &pass);

} // namespace faintline
