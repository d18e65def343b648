#pragma once

#include "plan/AnalysisPlan.h"
#include "track/Track.h"

#include <vector>

namespace faintline {

/// For each track the number of the call to which it belongs, or 0: the overtones of one voice are one call, whose number
/// is that of its strongest track.
///
/// Two tracks f and g are overtones of one voice if they move together at the ratio ρ = k/j of two numbers up to 16. What
/// that explains is g's own price: its place in the band, and its movement about a straight line,
///
///   ln(B/(s·√(2π))) + (n/2 - 1)·ln(1 + m²) - n·d²/2 - ln R ≥ T + sureMarginNats
///
///   B   width of the band, Hz
///   n   frames in which both are present, over 6, because neighbouring ones have errors alike; s: error of their mean, Hz
///   m²  mean square deviation of g from its straight line, d² that of g from ρ·f, both over their variance, which is
///       that of g plus ρ² times that of f (SmoothedPoint::deviation)
///   R   number of such ratios; the nearest to Σ f·g/Σ f² counts
///
/// the Bayes factor of a common movement against one of its own (Kass and Raftery 1995). Steady lines do not move, and
/// hardly reach it. The tracks are asked strongest first, each whether it leads others that are in no call yet.
///
/// Of lines with a second pass, in a recording whose frequencies are not offsets (I/Q), and not over a causal background,
/// over which events are told one by one; else all are 0.
std::vector<int> callsOf(const std::vector<Track> &tracks, const AnalysisPlan &plan);

} // namespace faintline
