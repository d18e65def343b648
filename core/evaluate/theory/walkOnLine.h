#pragma once

#include "model/SequentialModel.h"

namespace faintline {

/// The line of the general problem: M cells, a discretised Gaussian walk of `deviation` cells a stage, its first step
/// taken from the middle cell. 0: the trajectory is known; infinite: nothing is known at any stage, so it needs no
/// state. `snr`: ρ of exponential cells, power ratio. Source: Grossi and Lops 2006, sections 4.2 and 5.
SequentialModel walkOnLine(Index cells, double deviation, double snr);

/// Entropy rate of that walk over ln M: 0 where the trajectory is known, as that of one cell is, 1 where nothing is.
/// The stationary law of a symmetric step law renormalised row by row is proportional to the rows' sums.
double relativeEntropyRate(Index cells, double deviation);

} // namespace faintline
