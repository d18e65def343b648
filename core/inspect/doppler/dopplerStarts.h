#pragma once

#include "inspect/doppler/DopplerPass.h"

#include <vector>

namespace faintline {

/// Starting passes for a fit of these points: the `most` best, and the best of those heard before and after the points.
/// The best comes first.
///
/// Searches a grid over v, R/v and the time at which the closest approach is heard; f0 is the median of measured
/// frequency over f/f0. Passes are ranked by Σ |measured - fitted|/deviation, which is robust against a few outliers. v
/// starts where the pass just spans the points (5 to 95 %). At most 60 evenly spread points are used. Precondition:
/// times increase, frequencies above 0.
std::vector<DopplerPass> dopplerStarts(const std::vector<DopplerPoint> &points, double propagation, std::size_t most);

/// Passes long before and long after the points, at speeds up to 0.9 c, which may explain a constant frequency.
std::vector<DopplerPass> passesElsewhere(const std::vector<DopplerPoint> &points, double propagation);

/// Σ |measured - fitted|/deviation.
double absoluteMisfit(const std::vector<DopplerPoint> &points, double propagation, const DopplerPass &pass);

} // namespace faintline
