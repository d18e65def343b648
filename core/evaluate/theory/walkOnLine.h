#pragma once

#include "model/SequentialModel.h"

namespace faintline {

/// A line of M cells with a discretised Gaussian walk of `deviation` cells per stage, whose first step starts from the
/// middle cell. 0: known trajectory; ∞: unknown at each stage, which needs no state. `snr`: ρ of exponential cells,
/// power ratio. Source: Grossi and Lops 2006, sections 4.2 and 5.
SequentialModel walkOnLine(Index cells, double deviation, double snr);

/// Entropy rate of that walk over ln M: 0 for a known trajectory, including that of a single cell, 1 for an unknown
/// one. The stationary law of a symmetric step law renormalised row by row is proportional to the rows' sums.
double relativeEntropyRate(Index cells, double deviation);

} // namespace faintline
