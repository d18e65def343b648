#pragma once

#include "evaluate/experiments/Chart.h"
#include "evaluate/experiments/campaignCurve.h"

#include <cstddef>
#include <optional>

namespace faintline {

/// Measured curves of Pd against SNR, one for each name.
std::vector<Curve> curvesOf(const std::vector<CurvePoint> &points);

/// Pd against SNR, one measured curve per detector with its 95 % intervals.
///
/// Lines in simulated noise are evaluated at one false alarm per noise block (`pdAgainstBlocks`). Where Marcum's Q
/// holds, for a line of constant frequency and amplitude and an integrator of its duration n, a theory curve follows
/// that of the integrator:
///
///   Pd = Q_n(T),   P_fa(T) = n / cells of a block
///
/// with n looks, one per window, and as many independent cells as windows × resolution cells.
///
/// For a sweep: Pd against its parameter (`sweepChart`). Source: Billon 2005, section 5. Curves are in the order of the
/// detectors, so that curve i < detectors is detector i.
Chart pdChart(const Campaign &campaign);

/// Pd against false alarms per block, or per trial's path for lines injected into a recording, at one SNR: measured on
/// the available outcomes, with the same theory.
Chart rocChart(const Campaign &campaign, std::size_t snr);

/// Operating point of the detector with the given model and detector settings at a threshold: on the chart of Pd
/// against SNR its Pd for each SNR, dashed; on the ROC a single point, hollow. Nothing if no detector of the campaign
/// has these settings, or nothing has been measured.
std::optional<Curve> pdAtOperatingPoint(const Campaign &campaign, const AnalysisSettings &current, double threshold);
std::optional<Curve> operatingPoint(const Campaign &campaign, std::size_t snr, const AnalysisSettings &current,
                                    double threshold);

enum class SweepMeasure { Pd, FalseAlarms, Latency };

/// One measure against the parameter, with its 95 % intervals. Where no false alarm was counted the point is drawn at
/// 0.7 of one, the median of the remaining possibilities.
Chart sweepChart(const Campaign &campaign, SweepMeasure measure);

/// Pd against false alarms per hour, one point per value, in the order of the values.
Chart tradeOffChart(const Campaign &campaign);

/// Processor seconds per hour of recording against the parameter.
Chart costChart(const Experiment &experiment, const std::vector<double> &seconds);

} // namespace faintline
