#pragma once

#include "base/RunContext.h"
#include "frames/PeakPyramid.h"
#include "plan/Analysis.h"

#include <memory>

namespace faintline {

/// How much farther B lies above its threshold than A above its own, cell by cell, on B's axes; a picture on which no
/// decision is based.
///
///   Δ(t, f) = m_B(D_B(t, f)) - m_A(max D_A)      max over A's cells whose centres lie in B's cell, or the nearest one
///   m(D) = D - T                                 if both statistics are log-likelihoods in nat
///   m(D) = ln P(D' > T) - ln P(D' > D)           if one is a power (energy, integrator, P out of N): statistics of
///                                                different units are compared by their probability on noise
///                                                (Calibration)
///
/// Computed from the statistics' pictures, so rounded to ¼ nat and with as many frames per row as the coarser of them.
/// Null for frames on several axes. Cost: one table lookup per cell.
std::shared_ptr<const PeakPyramid> differencePicture(const Analysis &a, const Analysis &b,
                                                     const RunContext &context = {});

/// Whether the difference is one of log-likelihoods rather than of false-alarm probabilities.
bool haveCommonUnit(const Analysis &a, const Analysis &b);

} // namespace faintline
