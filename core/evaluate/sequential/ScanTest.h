#pragma once

#include "base/Field.h"
#include "detect/Sprt.h"
#include "evaluate/experiments/Chart.h"
#include "evaluate/sequential/SequentialTrial.h"
#include "evaluate/sequential/simulate.h"
#include "evaluate/theory/waldTheory.h"
#include "scene/ScanScene.h"

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// Above this SNR the quadrature of bounds (8a) and (8b) takes many seconds.
inline constexpr double highestDesignDb = 20.0;

/// A radar's sequential test on simulated scans: error probabilities, design, scene and number of trials. Source:
/// Grossi and Lops 2006, section 4 and Figure 4, whose radar gives the defaults.
struct ScanTest {
    SprtSettings sprt{1e-3, 1e-3, 20};
    double designSnrDb = 12.0; ///< of the target that the likelihood ratio assumes
    int averagedCells = 0;     ///< N of averagedStages; 0: known noise power
    ScanScene scene; ///< snrDb: the true SNR; `seed` sets all random numbers; `stages` and `hasTarget` are unused
    bool designFollows = false; ///< curves against SNR: each point is designed for its own SNR
    int walks = 100;            ///< tests of each hypothesis that are displayed individually
    int trials = 500;           ///< tests per point of a curve
    int sectors = 12;
    int targetSectors = 2; ///< number of sectors with a target, evenly spread
    int rounds = 8;

    static const std::vector<Field<ScanTest>> &fields();
    bool operator==(const ScanTest &) const = default;
};

/// The test for a scene: designed for its SNR, with its stages as cut-off.
ScanTest scanTestOf(const ScanScene &scene);

/// The field of that name; null if there is none. This and the following know the names of earlier versions, too.
const Field<ScanTest> *scanTestField(const std::string &name);

/// Reads what writeFields made. Throws Error naming `where`.
ScanTest scanTestFromJson(const Json &json, const std::string &where);

/// Sets one member from "name=value". Throws Error.
void setScanTestField(ScanTest &test, const std::string &assignment);

/// Throws Error naming the member. At most 2²⁰ cells per scan, so that a window remains responsive.
void checkScanTest(const ScanTest &test);

/// The test's model of the scene's target: azimuth, elevation and range walk as in the scene, Doppler is folded.
SequentialModel scanModel(const ScanScene &scene, double designSnrDb);

/// Maximum number of stages of a single test: its cut-off, or 2000 without one.
Index stageLimit(const ScanTest &test);

/// A test that can be repeated: with or without a target, and its number.
struct ScanRun {
    bool hasTarget = false;
    int number = 0;
    bool operator==(const ScanRun &) const = default;
};

/// The target's cells in a run (azimuth, elevation, range, Doppler) at each stage it may take; empty without a target.
std::vector<ScanCell> truthOf(const ScanTest &test, const ScanRun &run);

/// The scans of a run. Runs are independent of each other, also those with and without a target; each is a pure
/// function of (seed, run).
StageSource scanStages(const ScanTest &test, const ScanRun &run);

/// Received power at a stage, maximum over azimuth and elevation, in dB over the noise: range cells × Doppler cells. If
/// the noise power is estimated, as seen by the test.
std::vector<float> rangeDopplerDb(const ScanTest &test, const ScanRun &run, Index stage);

/// Runs one test; `model` is scanModel of the test. Throws Error, Cancelled.
SprtResult walkScan(const ScanTest &test, const SequentialModel &model, const ScanRun &run,
                    const RunContext &context = {});

/// Whether a sector holds a target. Targets are spread evenly around the horizon; sector 0 is not among the first.
bool holdsTarget(const ScanTest &test, Index sector);

/// Rounds of looks into all sectors, each look in its own scans, with a target if its sector has one. `fixedSize`:
/// stages per look of a test of fixed size. Throws Error, Cancelled.
SectorRounds visitSectorsOf(const ScanTest &test, Index fixedSize, const RunContext &context = {});

/// The same scenario for `simulate`: designed for one SNR, run at another or on noise.
SequentialStudy studyOf(const ScanTest &test, double designSnrDb, std::optional<double> actualSnrDb);

/// Number of stages of a test of fixed size with the same errors at the design SNR, from as many trials as β needs but
/// at most 2000, up to 40 stages; nothing if more are needed. An estimate (simulatedFixedSampleSize). Throws Error,
/// Cancelled.
std::optional<Index> fixedSizeOf(const ScanTest &test, const RunContext &context = {});

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
