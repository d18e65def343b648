#pragma once

#include "plan/Analysis.h"

namespace faintline {

/// Moves tracks that the recording's own noise explains (OwnNoiseLaw) from `tracks` to `explainedByNoise`.
///
/// A track is kept if its statistic D, without the share of its evidence that this noise explains, reaches the
/// threshold T:
///
///   D · Λ(ḡ)/Λ(ȳ) / V̄(n) ≥ T,   Λ(a) = n (a - 1 - ln a)
///
/// ȳ, ḡ, V̄: means of y, g(y) and V(n) over the track's n points. Λ is the log-likelihood ratio of exponential cells of
/// an unknown mean a > 1 to noise, and V(n) cells in a run count as one. A path through many small excesses keeps its
/// share, because there g(y) ≈ y; one that depends on a few high cells, or on a run of raised cells, of a kind that
/// this noise has everywhere, loses it. If the noise is as assumed, all tracks are kept.
///
/// Numbers are not changed. Nothing is done if tracks have no second pass (secondLook.h), and for families, which have
/// their own members beside them. Throws Cancelled.
void holdAgainstOwnNoise(Analysis &analysis, const RunContext &context);

} // namespace faintline
