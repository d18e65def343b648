#pragma once

#include "evaluate/experiments/Chart.h"
#include "evaluate/sequential/ScanTest.h"
#include "evaluate/sequential/simulate.h"
#include "evaluate/theory/waldTheory.h"

#include <optional>
#include <vector>

namespace faintline {

/// A radar's test at one true SNR, and on noise.
struct ScanPoint {
    double snrDb = 0.0;
    double designSnrDb = 0.0;
    SequentialOutcome h0;
    SequentialOutcome h1;
    WaldBounds bounds; ///< (8a), (8b) at the design SNR for all cells of a scan
};

/// SNRs of the curves: from 12 dB below to 4 dB above the design SNR, every 2 dB, as far as a design may follow.
std::vector<double> curveSnrs(const ScanTest &test);

/// Simulates one. `before`: another point of the same test, which lends what does not depend on the true SNR. Throws
/// Error, Cancelled.
ScanPoint measureScanPoint(const ScanTest &test, double snrDb, const ScanPoint *before = nullptr,
                           const RunContext &context = {});

/// ASN and coefficient of variation of both hypotheses against the true SNR, as Figure 4 of Grossi and Lops 2006; the
/// ASN with bounds (8a) and (8b), which hold where the design SNR is the true one. Points in any order.
Chart stagesChart(std::vector<ScanPoint> points);
Chart variationChart(std::vector<ScanPoint> points);

/// Stages on a line against knowledge of the trajectory, as Figure 2 of Grossi and Lops 2006: designed for the true
/// SNR, never cut off, noise power known.
struct PriorPoint {
    double deviation = 0.0;   ///< σ of a step, cells; 0 known, ∞ nothing known
    double entropyRate = 0.0; ///< over ln M
    SequentialOutcome h0;
    SequentialOutcome h1;
};
struct PriorCurve {
    int cells = 0; ///< M
    WaldBounds bounds;
    std::vector<PriorPoint> points;
};

/// As many cells as the scene has in range, at most 1000; no points yet.
PriorCurve startPriorCurve(const ScanTest &test);
/// σ of the points, 0 to ∞.
const std::vector<double> &priorDeviations();
PriorPoint measurePriorPoint(const ScanTest &test, const PriorCurve &curve, double deviation,
                             const RunContext &context = {});
Chart priorChart(const PriorCurve &curve);

/// By which share the simulated ASN exceeds the "upper bounds" where nothing is known of the trajectory: they neglect
/// by how far ln Λ overshoots its boundary. Nothing before that point is there.
struct Overshoot {
    double h0 = 0.0;
    double h1 = 0.0;
};
std::optional<Overshoot> overshoot(const PriorCurve &curve);

} // namespace faintline
