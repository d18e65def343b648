#pragma once

#include "analysis/Analysis.h"

#include <vector>

namespace faintline {

/// Whether tracks are held against the recording's own noise: those that are looked at twice, of a single line's grid.
bool isHeldAgainstOwnNoise(const AnalysisPlan &analysis);

/// Tracks parted by what their power is worth in the noise that the recording really has (OwnNoiseLaw).
struct OverOwnNoise {
    std::vector<Track> kept;
    std::vector<Track> explained; ///< by that noise
};

/// A track is kept where its statistic D, less the share of its evidence that the recording's own noise explains,
/// reaches the threshold T:
///
///   D · Λ(ḡ)/Λ(ȳ) ≥ T,   Λ(a) = n (a - 1 - ln a)
///
/// ȳ, ḡ: means over the track's n points of y and of g(y); Λ is the logarithm of the likelihood ratio of exponential
/// cells of an unknown mean a > 1 to noise. A path through many small excesses keeps its share, for there g(y) ≈ y; one
/// that rests on a few high cells of a kind that this noise has everywhere loses it. Where the noise is exponential
/// everything is kept. Numbers stay as they are. Throws Cancelled.
OverOwnNoise holdAgainstOwnNoise(const Analysis &analysis, std::vector<Track> tracks, const RunContext &context);

} // namespace faintline
