#pragma once

#include "base/Field.h"
#include "detect/Sprt.h"
#include "evaluate/sequential/SequentialStudy.h"
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
Survey surveyScans(const ScanTest &test, Index fixedSize, const RunContext &context = {});

/// The same scenario for `simulate`: designed for one SNR, run at another or on noise.
SequentialStudy studyOf(const ScanTest &test, double designSnrDb, std::optional<double> actualSnrDb);

/// Number of stages of a test of fixed size with the same errors at the design SNR, from as many trials as β needs but
/// at most 2000, up to 40 stages; nothing if more are needed. An estimate (simulatedFixedSampleSize). Throws Error,
/// Cancelled.
std::optional<Index> fixedSizeOf(const ScanTest &test, const RunContext &context = {});

} // namespace faintline
