#include "evaluate/sequential/ScanTest.h"

#include "base/Error.h"
#include "base/json.h"
#include "base/logmath.h"
#include "detect/averagedStages.h"
#include "evaluate/sequential/simulate.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr Index scanLimitStages = 2000;
    constexpr double mostCells = 0x1p20;
    constexpr int firstLook = 1 << 24; ///< first run number of the survey

    KinematicAxis spatialAxis(const char *name, Index cells, const ScanScene &scene)
    {
        KinematicAxis axis;
        axis.name = name;
        axis.cells = cells;
        axis.step = scene.moves == ScanMoves::Uniform ? std::vector{1.0 / 3.0, 1.0 / 3.0}
                                                      : gaussianStep(scene.moveCells, cells);
        axis.renormalised = true;
        return axis;
    }

    ScanScene sceneOf(const ScanTest &test, const ScanRun &run)
    {
        ScanScene scene = test.scene;
        scene.hasTarget = run.hasTarget;
        scene.stages = int(stageLimit(test));
        return scene;
    }

    /// Stream of the scene: the two hypotheses do not share their noise.
    int streamOf(const ScanRun &run)
    {
        return 2 * run.number + (run.hasTarget ? 1 : 0);
    }

} // namespace

const std::vector<Field<ScanTest>> &ScanTest::fields()
{
    using S = ScanTest;
    static const std::vector<Field<S>> table = [] {
        const auto sprt = [](auto &test) { return &test.sprt; };
        const auto scene = [](auto &test) { return &test.scene; };
        std::vector<Field<S>> all = within<S>("sprt", SprtSettings::fields(), sprt);
        all.push_back(field(&S::designSnrDb, "design.snrDb", "dB", -20.0, highestDesignDb,
                            "SNR of the target for which the test "
                            "is designed.")
                          .labelled("Design SNR")
                          .advised("Lower it for weaker targets: the test then takes longer to decide against noise."));
        all.push_back(
            field(&S::averagedCells, "design.averagedCells", "", 0.0, 65536.0,
                  "Neighbours in range whose mean estimates the noise power; 0: the noise power is known.")
                .labelled("Averaged cells")
                .advised(
                    "Raise it for a steadier estimate of the noise; it must not extend to where the clutter differs."));
        for (Field<S> &one : within<S>("scene", ScanScene::fields(), scene))
            if (one.name != "scene.stages" && one.name != "scene.hasTarget" && one.name != "scene.secondsPerStage")
                all.push_back(std::move(one));
        all.push_back(field(&S::walks, "runs.walks", "", 1.0, 2000.0,
                            "Number of tests of each hypothesis shown "
                            "individually.")
                          .labelled("Walks shown"));
        all.push_back(field(&S::trials, "runs.trials", "", 20.0, 100000.0, "Number of tests per point of a curve.")
                          .labelled("Tests per point")
                          .advised("The width of a point's interval falls with the square root of this number; time is "
                                   "proportional to it."));
        all.push_back(field(&S::designFollows, "runs.designFollows", "Design the test for each SNR of the curves.")
                          .labelled("Design at each SNR"));
        all.push_back(
            field(&S::sectors, "survey.sectors", "", 1.0, 360.0, "Number of angular sectors visited in turn."));
        all.push_back(field(&S::targetSectors, "survey.targetSectors", "", 0.0, 360.0,
                            "Number of sectors with a "
                            "target.")
                          .labelled("With a target"));
        all.push_back(field(&S::rounds, "survey.rounds", "", 1.0, 1000.0, "Number of looks at each sector."));
        return all;
    }();
    return table;
}

ScanTest scanTestOf(const ScanScene &scene)
{
    ScanTest test;
    test.scene = scene;
    test.designSnrDb = scene.snrDb;
    test.sprt.cutOffStage = scene.stages;
    return test;
}

void setScanTestField(ScanTest &test, const std::string &assignment)
{
    const std::size_t equals = assignment.find('=');
    const std::string name = assignment.substr(0, equals);
    for (const Field<ScanTest> &one : ScanTest::fields())
        if (one.name == name && equals != std::string::npos)
            return one.set(test, parseFieldValue(one, assignment.substr(equals + 1)));
    std::string names;
    for (const Field<ScanTest> &one : ScanTest::fields())
        names += (names.empty() ? "" : ", ") + one.name;
    throw Error(assignment, "must be name=value; settings of a radar test are " + names);
}

void checkScanTest(const ScanTest &test)
{
    checkFields(test, ScanTest::fields());
    checkSprt(test.sprt, "sprt");
    if (test.sprt.cutOffStage > scanLimitStages)
        throw fieldError("sprt.cutOffStage", std::to_string(test.sprt.cutOffStage),
                         "must lie in 0 … " + std::to_string(scanLimitStages) + " if tests are simulated");
    ScanScene scene = test.scene;
    scene.stages = 1;
    checkScene(scene);
    const double cells = double(scanGrid(scene).size());
    if (cells > mostCells)
        throw fieldError("scene.rangeCells", std::to_string(scene.rangeCells),
                         "gives a scan of " + formatNumber(cells) + " cells; at most 2²⁰ are simulated");
    if (test.averagedCells >= test.scene.rangeCells)
        throw fieldError("design.averagedCells", std::to_string(test.averagedCells),
                         "must be less than the " + std::to_string(test.scene.rangeCells) + " range cells");
    if (test.targetSectors > test.sectors)
        throw fieldError("survey.targetSectors", std::to_string(test.targetSectors),
                         "must be at most the number of sectors, " + std::to_string(test.sectors));
}

SequentialModel scanModel(const ScanScene &scene, double designSnrDb)
{
    KinematicAxis doppler;
    doppler.name = "Doppler";
    doppler.cells = scene.dopplerCells;
    return makeSequentialModel(
        {spatialAxis("azimuth", scene.azimuthCells, scene), spatialAxis("elevation", scene.elevationCells, scene),
         spatialAxis("range", scene.rangeCells, scene), doppler},
        {false, false, false, true}, Likelihood(LikelihoodKind::Exponential, ratioFromDb(designSnrDb)));
}

Index stageLimit(const ScanTest &test)
{
    return test.sprt.cutOffStage > 0 ? test.sprt.cutOffStage : scanLimitStages;
}

std::vector<ScanCell> truthOf(const ScanTest &test, const ScanRun &run)
{
    return scanTrajectory(sceneOf(test, run), streamOf(run));
}

StageSource scanStages(const ScanTest &test, const ScanRun &run)
{
    const ScanScene scene = sceneOf(test, run);
    StageSource source = [scene, stream = streamOf(run), path = scanTrajectory(scene, streamOf(run)),
                          y = std::vector<float>(std::size_t(scanGrid(scene).size()))](Index stage,
                                                                                       std::span<double> out) mutable {
        readScan(scene, path, stream, stage, y);
        std::copy(y.begin(), y.end(), out.begin());
    };
    if (test.averagedCells == 0)
        return source;
    return averagedStages(std::move(source), scanModel(test.scene, test.designSnrDb), test.averagedCells,
                          "design.averagedCells");
}

std::vector<float> rangeDopplerDb(const ScanTest &test, const ScanRun &run, Index stage)
{
    const auto plane = std::size_t(test.scene.rangeCells) * std::size_t(test.scene.dopplerCells);
    std::vector<double> y(std::size_t(scanGrid(test.scene).size()));
    scanStages(test, run)(stage, y);
    std::vector<float> map(plane, 0.0f);
    for (std::size_t cell = 0; cell < y.size(); ++cell)
        map[cell % plane] = std::max(map[cell % plane], float(y[cell]));
    for (float &value : map)
        value = float(dbFromRatio(std::max(1e-6, double(value))));
    return map;
}

SprtResult walkScan(const ScanTest &test, const SequentialModel &model, const ScanRun &run, const RunContext &context)
{
    return runSprt(model, test.sprt, stageLimit(test), scanStages(test, run), context);
}

bool holdsTarget(const ScanTest &test, Index sector)
{
    for (Index target = 0; target < test.targetSectors; ++target)
        if ((2 * target + 1) * test.sectors / (2 * test.targetSectors) == sector)
            return true;
    return false;
}

Survey surveyScans(const ScanTest &test, Index fixedSize, const RunContext &context)
{
    const auto source = [&](const SectorVisit &visit) {
        return scanStages(
            test, {holdsTarget(test, visit.sector), firstLook + int(visit.round * test.sectors + visit.sector)});
    };
    return survey(scanModel(test.scene, test.designSnrDb), test.sprt,
                  {test.sectors, test.rounds, stageLimit(test), fixedSize}, source, context);
}

SequentialStudy studyOf(const ScanTest &test, double designSnrDb, std::optional<double> actualSnrDb)
{
    SequentialStudy study;
    study.model = scanModel(test.scene, designSnrDb);
    study.sprt = test.sprt;
    if (actualSnrDb)
        study.actualSnr = ratioFromDb(*actualSnrDb);
    study.trials = test.trials;
    study.seed = std::uint64_t(test.scene.seed);
    study.averagedCells = test.averagedCells;
    return study;
}

std::optional<Index> fixedSizeOf(const ScanTest &test, const RunContext &context)
{
    constexpr Index fixedSampleLimitStages = 40;
    SequentialStudy study = studyOf(test, test.designSnrDb, {});
    study.trials = Index(std::clamp(3.0 / test.sprt.miss, 200.0, 2000.0));
    return simulatedFixedSampleSize(study, fixedSampleLimitStages, context);
}

} // namespace faintline
