#pragma once

#include "analysis/Calibration.h"
#include "analysis/noiseCounts.h"

#include <span>
#include <vector>

namespace faintline {

// How often events come at which threshold, from counts at a few and from splitting.

/// Thresholds at which chains may be expected to find events at about the wanted rates, by a rough look at the maxima
/// of space-time blocks: with P(max ≤ T) = exp(-Λ e^{-θ(T-u)}), Λ and θ from two quantiles.
std::vector<double> thresholdsForEvents(std::vector<float> maxima, double cellFramesPerBlock, double cellFrames,
                                        bool isLine);

/// Fits ln(rate) = ln(rate at the anchor) - θ(T - anchor) to Poisson counts of events at several thresholds, by maximum
/// likelihood.
void fitEventRate(std::span<const double> thresholds, std::span<const double> events, double cellFrames,
                  Calibration &result);

/// The tail of the chain's events: the shape is that of excursions, ln S(T), the height that of the counts,
///
///   ln rate(T) = ln S(T) + δ(T)
///   δ = ln(events/noise) - ln S at the thresholds, linear between them, constant beyond
void anchorTail(const RareRates &rare, std::span<const double> thresholds, const EventCounts &counts,
                Calibration &result);

} // namespace faintline
