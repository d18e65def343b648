#pragma once

#include "plan/AnalysisPlan.h"
#include "track/Track.h"

#include <vector>

namespace faintline {

/// For each track the number of the call to which it belongs, or 0: the overtones of one source, as of a voice or an
/// engine, are one call, whose number is that of its strongest track.
///
/// Tracks f and g are such overtones if they lie, and move, at the ratio ρ = k/j of two numbers up to 16. What that
/// explains is the logarithm of the Bayes factor of a common course against one of its own, in nats:
///
///   E = ln P(ρ) + place + slope + movement
///
///   place     ln(B/(s·√(2π))) - ½·(Δ/s)²          Δ: mean of g - ρ·f, Hz, s: its error; B: width of the band
///   slope     ½·ln(1 + (b/σ)²) - ½·(Δb/σ)²        b: slope of g, Δb: that of g - ρ·f, σ: its error
///   movement  (n - 2)·(ln p1 - ln p2)             of the deviations from both straight lines, normal: for one movement, of
///             variance τ² = mean of f·g/ρ or 0, with covariances τ²·(1 ρ; ρ ρ²); for two, of their likeliest variances
///
///   P(ρ)      1/(j·k) over the sum of all: low overtones are usual; of the ratio nearest to that of the means
///   n         frames in which both are present, over 6, because neighbouring ones have errors alike. These have the
///             variances of the positions (SmoothedPoint::deviation).
///
/// The strongest track that is in no call yet leads one, with all those of E > ln M, where M tracks are present together
/// with it, if
///
///   Σ (E - ln M) ≥ ln N + sureMarginNats
///
/// so that chance makes a call of N tracks in fewer than one of 25 recordings (Kass and Raftery 1995, Bayes factors).
///
/// Of lines, or families, with a second pass, in a recording whose frequencies are not offsets (I/Q), and not over a causal
/// background, over which events are told one by one; else all are 0.
std::vector<int> callsOf(const std::vector<Track> &tracks, const AnalysisPlan &plan);

} // namespace faintline
