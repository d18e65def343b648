#pragma once

#include "calibrate/noiseCounts.h"
#include "plan/Calibration.h"

#include <span>
#include <vector>

namespace faintline {

// Event rate as a function of the threshold, from counts at a few thresholds and from splitting.

/// How the tail beyond the counted thresholds is known.
enum class TailShape {
    Line,     ///< extrapolated
    Followed, ///< by splitting
    Blocks    ///< followed, of a detector that decides at the ends of blocks
};

/// Thresholds at which chains are expected to find events at about the wanted rates, from a rough analysis of the
/// maxima of space-time blocks: P(max ≤ T) = exp(-Λ e^{-θ(T-u)}), with Λ and θ from two quantiles.
std::vector<double> thresholdsForEvents(std::vector<float> maxima, double cellFramesPerBlock, double cellFrames,
                                        TailShape shape);

/// Fits ln(rate) = ln(rate at the anchor) - θ(T - anchor) to Poisson counts of events at several thresholds, by maximum
/// likelihood.
void fitEventRate(std::span<const double> thresholds, std::span<const double> events, double cellFrames,
                  Calibration &result);

/// The tail of the chain's events: excursions, ln S(T), give the shape, the counts the height,
///
///   ln rate(T) = ln S(T) + δ(T)
///   δ = ln(events/noise) - ln S at the thresholds, linear between them, constant beyond
void anchorTail(const RareRates &rare, std::span<const double> thresholds, const EventCounts &counts,
                Calibration &result);

} // namespace faintline
