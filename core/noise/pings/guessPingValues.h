#pragma once

#include "signal/RawPings.h"

namespace faintline {

/// What the numbers of recorded pings are, guessed from up to 64 of them. `Normalised` only if they are floats without
/// negative values whose noise is level over range and beams, with a mean of 0.1 … 10, and if they are fewer than 4096.
///
/// Other numbers are told apart by neighbouring pings of the same cell, whose noise is alike. Of exponential power, the
/// logarithm of their ratio has the logistic law, with median magnitude ln 3; of magnitudes half that; and decibels
/// differ by 10 log10 3 = 4.8 dB. Power averaged over four looks or more resembles magnitudes.
PingValues guessPingValues(const RawPings &pings);

} // namespace faintline
