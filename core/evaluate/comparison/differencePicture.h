#pragma once

#include "analysis/analyse.h"
#include "spectrum/PeakPyramid.h"

#include <memory>

namespace faintline {

/// By how much B lies farther above its threshold than A above its own, cell by cell, on B's axes: a picture, no
/// decision rests on it.
///
///   Δ(t, f) = m_B(D_B(t, f)) - m_A(max D_A)      max over A's cells whose centres lie in B's cell, or the nearest one
///   m(D) = D - T                                 where both statistics are log-likelihoods in nat
///   m(D) = ln P(D' > T) - ln P(D' > D)           where one is a power (energy, integrator, P out of N): statistics of
///                                                different units cannot be compared, but how rare they are on noise
///                                                (Calibration) can
///
/// Made from the statistics' pictures, so rounded to ¼ nat and with as many frames a row as the coarser of them. Frames
/// on several axes have no such picture; the answer is null. Cost: a look into a table for each cell.
std::shared_ptr<const PeakPyramid> differencePicture(const Analysis &a, const Analysis &b,
                                                     const RunContext &context = {});

/// Whether the difference is one of log-likelihoods, or else of false-alarm probabilities.
bool haveCommonUnit(const Analysis &a, const Analysis &b);

} // namespace faintline
