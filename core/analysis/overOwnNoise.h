#pragma once

#include "analysis/Analysis.h"

namespace faintline {

/// Moves tracks that the recording's own noise explains (OwnNoiseLaw) from `tracks` to `explainedByNoise`.
///
/// A track is kept where its statistic D, less the share of its evidence that this noise explains, reaches the
/// threshold T:
///
///   D · Λ(ḡ)/Λ(ȳ) / V̄(n) ≥ T,   Λ(a) = n (a - 1 - ln a)
///
/// ȳ, ḡ, V̄: means over the track's n points of y, g(y) and V(n); Λ is the logarithm of the likelihood ratio of
/// exponential cells of an unknown mean a > 1 to noise, and V(n) of them that come in runs tell as much as one. A path
/// through many small excesses keeps its share, for there g(y) ≈ y; one that rests on a few high cells, or on a run of
/// raised ones, of a kind that this noise has everywhere loses it. Where the noise is as assumed everything is kept.
///
/// Numbers stay as they are. Nothing is done where tracks are not looked at twice (secondLook.h), and of families,
/// beside which their own members lie. Throws Cancelled.
void holdAgainstOwnNoise(Analysis &analysis, const RunContext &context);

} // namespace faintline
