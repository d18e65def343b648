#pragma once

#include "base/Field.h"
#include "detect/Survey.h"
#include "evaluate/sequential/SequentialStudy.h"
#include "recording/ScanScene.h"

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// Beyond it the quadrature of bounds (8a) and (8b) takes more than seconds.
inline constexpr double highestDesignDb = 20.0;

/// A radar's sequential test on simulated scans: how sure it has to be, what it is designed for, what is there, and how
/// often it is tried. Source: Grossi and Lops 2006, section 4 and Figure 4, whose radar the defaults are.
struct ScanTest {
    SprtSettings sprt{1e-3, 1e-3, 20};
    double designSnrDb = 12.0; ///< of the target that the likelihood ratio expects
    int averagedCells = 0;     ///< N of averagedStages; 0: the noise power is known
    ScanScene scene; ///< snrDb: the true SNR; `stages` and `hasTarget` go unread, `seed` names all random numbers
    bool designFollows = false; ///< the curves against the SNR: each point is designed for its own
    int walks = 100;            ///< tests of each hypothesis that are shown one by one
    int trials = 500;           ///< tests behind each point of a curve
    int sectors = 12;
    int targetSectors = 2; ///< of the sectors, evenly spread, hold a target
    int rounds = 8;

    static const std::vector<Field<ScanTest>> &fields();
    bool operator==(const ScanTest &) const = default;
};

/// The test that goes with a scene: designed for its SNR, cut off after its stages.
ScanTest scanTestOf(const ScanScene &scene);

/// Sets one member from "name=value". Throws Error.
void setScanTestField(ScanTest &test, const std::string &assignment);

/// Throws Error naming the member. At most 2²⁰ cells a scan, so that a window stays answering.
void checkScanTest(const ScanTest &test);

/// The scene's target as the test sees it: azimuth, elevation and range walk as the scene's do, Doppler is folded.
SequentialModel scanModel(const ScanScene &scene, double designSnrDb);

/// Stages a single test may take: its cut-off, or 2000 where it has none.
Index stageLimit(const ScanTest &test);

/// A test that can be made again: with or without a target, and its number.
struct ScanRun {
    bool hasTarget = false;
    int number = 0;
    bool operator==(const ScanRun &) const = default;
};

/// The target's cells in a run, azimuth, elevation, range, Doppler, at every stage it may take; empty without a target.
std::vector<ScanCell> truthOf(const ScanTest &test, const ScanRun &run);

/// The scans of a run. Runs are independent of each other, those with and without a target too; each is a pure function
/// of (seed, run).
StageSource scanStages(const ScanTest &test, const ScanRun &run);

/// What the radar receives at a stage, largest over azimuth and elevation, in dB over the noise: range cells × Doppler
/// cells. Where the noise's power is estimated, as the test sees it.
std::vector<float> rangeDopplerDb(const ScanTest &test, const ScanRun &run, Index stage);

/// One test of `model`, which is scanModel of the test. Throws Error, Cancelled.
SprtResult walkScan(const ScanTest &test, const SequentialModel &model, const ScanRun &run,
                    const RunContext &context = {});

/// Whether a sector holds a target: those nearest to equal distances around the horizon, sector 0 not among the first.
bool holdsTarget(const ScanTest &test, Index sector);

/// Rounds of looks into all sectors, each look with a target or without by its sector, in scans of its own.
/// `fixedSize`: stages that a test of fixed size would spend a look. Throws Error, Cancelled.
Survey surveyScans(const ScanTest &test, Index fixedSize, const RunContext &context = {});

/// The same world for `simulate`: designed for one SNR, run at another or on noise.
SequentialStudy studyOf(const ScanTest &test, double designSnrDb, std::optional<double> actualSnrDb);

/// Stages of a test of fixed size with the same errors at the design SNR, from as many trials as β needs but at most
/// 2000, among up to 40 stages; nothing where more are needed. An estimate (simulatedFixedSampleSize). Throws Error,
/// Cancelled.
std::optional<Index> fixedSizeOf(const ScanTest &test, const RunContext &context = {});

} // namespace faintline
