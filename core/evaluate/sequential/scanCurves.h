#pragma once

#include "evaluate/experiments/Chart.h"
#include "evaluate/sequential/ScanTest.h"
#include "evaluate/sequential/simulate.h"
#include "evaluate/theory/waldTheory.h"

#include <optional>
#include <vector>

namespace faintline {

/// Result of a radar's test at one true SNR, and on noise.
struct ScanPoint {
    double snrDb = 0.0;
    double designSnrDb = 0.0;
    SequentialOutcome h0;
    SequentialOutcome h1;
    WaldBounds bounds; ///< (8a), (8b) at the design SNR for all cells of a scan
};

/// SNRs of the curves: from 12 dB below to 4 dB above the design SNR in steps of 2 dB, limited to valid designs.
std::vector<double> curveSnrs(const ScanTest &test);

/// Simulates one point. `before`: another point of the same test, from which results that do not depend on the true SNR
/// are reused. Throws Error, Cancelled.
ScanPoint measureScanPoint(const ScanTest &test, double snrDb, const ScanPoint *before = nullptr,
                           const RunContext &context = {});

/// ASN and coefficient of variation of both hypotheses against the true SNR, as in Figure 4 of Grossi and Lops 2006;
/// the ASN with bounds (8a) and (8b), which hold where the design SNR is the true one. Points in any order.
Chart stagesChart(std::vector<ScanPoint> points);
Chart variationChart(std::vector<ScanPoint> points);

/// Stages on a line against knowledge of the trajectory, as in Figure 2 of Grossi and Lops 2006: designed for the true
/// SNR, without a cut-off, with known noise power.
struct PriorPoint {
    double deviation = 0.0;   ///< σ of a step, cells; 0: known, ∞: unknown
    double entropyRate = 0.0; ///< relative to ln M
    SequentialOutcome h0;
    SequentialOutcome h1;
};
struct PriorCurve {
    int cells = 0; ///< M
    WaldBounds bounds;
    std::vector<PriorPoint> points;
};

/// A curve for as many cells as the scene has in range, at most 1000; without points.
PriorCurve startPriorCurve(const ScanTest &test);
/// σ of the points, 0 to ∞.
const std::vector<double> &priorDeviations();
PriorPoint measurePriorPoint(const ScanTest &test, const PriorCurve &curve, double deviation,
                             const RunContext &context = {});
Chart priorChart(const PriorCurve &curve);

/// Fraction by which the simulated ASN exceeds the "upper bounds" for an unknown trajectory: they neglect by how far ln
/// Λ overshoots its boundary. Nothing until that point is measured.
struct Overshoot {
    double h0 = 0.0;
    double h1 = 0.0;
};
std::optional<Overshoot> overshoot(const PriorCurve &curve);

} // namespace faintline
