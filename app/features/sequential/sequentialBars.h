#pragma once

#include "widgets/plot/BarPlot.h"

#include <vector>

namespace faintline {

class SequentialTests;

/// Number of tests that stopped after 1, 2, … stages: those on noise only, and those on a target. No values for a test
/// on a recording, because a single test has no histogram.
std::vector<BarPlot::Series> stoppingBars(const SequentialTests &tests);

/// Dwell time on each sector over all rounds, in mean stages per look: empty sectors, and those with a target. No values
/// without rounds.
std::vector<BarPlot::Series> sectorBars(const SequentialTests &tests);

} // namespace faintline
