#include "evaluate/sequential/ScanTest.h"

#include "base/Error.h"
#include "base/json.h"
#include "base/logmath.h"
#include "base/oneLine.h"
#include "detect/averagedStages.h"
#include "evaluate/sequential/simulate.h"
#include "evaluate/theory/walkOnLine.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    constexpr Index scanLimitStages = 2000;
    constexpr double mostCells = 0x1p20;
    constexpr int firstLook = 1 << 24; ///< first run number of the sectors

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

    /// The name of a setting, from one that earlier versions gave it, too.
    std::string currentName(const std::string &name)
    {
        return name == "survey.sectors"         ? "sectors.count"
               : name == "survey.targetSectors" ? "sectors.withTarget"
               : name == "survey.rounds"        ? "sectors.rounds"
                                                : name;
    }

    /// Stream of the scene: the two hypotheses do not share their noise.
    int streamOf(const ScanRun &run)
    {
        return 2 * run.number + (run.hasTarget ? 1 : 0);
    }

    const std::string onNoise = "H0, noise only";
    const std::string withTarget = "H1, a target";

    void sortBySnr(std::vector<ScanPoint> &points)
    {
        std::sort(points.begin(), points.end(),
                  [](const ScanPoint &a, const ScanPoint &b) { return a.snrDb < b.snrDb; });
    }

    Curve::Point pointAt(double x, const Estimate &estimate)
    {
        return {x, estimate.value, estimate.interval()};
    }

    /// The curves of both hypotheses.
    std::vector<Curve> measured(const std::vector<ScanPoint> &points, Estimate SequentialOutcome::*what)
    {
        Curve h0{onNoise, Curve::Kind::Measured, {}};
        Curve h1{withTarget, Curve::Kind::Measured, {}};
        for (const ScanPoint &point : points) {
            h0.points.push_back(pointAt(point.snrDb, point.h0.*what));
            h1.points.push_back(pointAt(point.snrDb, point.h1.*what));
        }
        return {std::move(h0), std::move(h1)};
    }

    struct Bound {
        const char *name;
        double WaldBounds::*value;
        bool isOfTarget;
    };
    constexpr Bound bounds[] = {{", (8b) lower", &WaldBounds::h0Low, false},
                                {", (8b) upper", &WaldBounds::h0High, false},
                                {", (8a) lower", &WaldBounds::h1Low, true},
                                {", (8a) upper", &WaldBounds::h1High, true}};

    std::string boundName(const Bound &bound)
    {
        return (bound.isOfTarget ? withTarget : onNoise) + bound.name;
    }

    /// Bound for designs at the true SNR; with a single design, a target's bounds are a short dash there.
    Curve boundCurve(const std::vector<ScanPoint> &points, const Bound &bound)
    {
        constexpr double halfDashDb = 0.6;
        Curve curve{boundName(bound), Curve::Kind::Theory, {}};
        const bool isOneDesign = points.front().designSnrDb == points.back().designSnrDb;
        if (isOneDesign && bound.isOfTarget) {
            const double at = points.front().designSnrDb;
            const double value = points.front().bounds.*bound.value;
            curve.points = {{at - halfDashDb, value, {}}, {at + halfDashDb, value, {}}};
            return curve;
        }
        for (const ScanPoint &point : points)
            curve.points.push_back({point.snrDb, point.bounds.*bound.value, {}});
        return curve;
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
        all.push_back(field(&S::sectors, "sectors.count", "", 1.0, 360.0, "Number of angular sectors visited in turn.")
                          .labelled("Sectors"));
        all.push_back(field(&S::targetSectors, "sectors.withTarget", "", 0.0, 360.0,
                            "Number of sectors with a "
                            "target.")
                          .labelled("With a target"));
        all.push_back(field(&S::rounds, "sectors.rounds", "", 1.0, 1000.0, "Number of looks at each sector."));
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

const Field<ScanTest> *scanTestField(const std::string &name)
{
    const auto found = std::ranges::find(ScanTest::fields(), currentName(name), &FieldInfo::name);
    return found == ScanTest::fields().end() ? nullptr : &*found;
}

ScanTest scanTestFromJson(const Json &json, const std::string &where)
{
    Json renamed = json;
    for (const char *name : {"survey.sectors", "survey.targetSectors", "survey.rounds"})
        if (json.is_object() && json.contains(name)) {
            renamed[currentName(name)] = json[name];
            renamed.erase(name);
        }
    ScanTest test;
    readFields(renamed, ScanTest::fields(), test, where);
    return test;
}

void setScanTestField(ScanTest &test, const std::string &assignment)
{
    const std::size_t equals = assignment.find('=');
    const std::string name = assignment.substr(0, equals);
    if (const Field<ScanTest> *field = scanTestField(name); field && equals != std::string::npos)
        return field->set(test, parseFieldValue(*field, assignment.substr(equals + 1)));
    throw Error(assignment,
                "must be name=value; settings of a radar test are " + listed(ScanTest::fields(), &FieldInfo::name));
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
        throw fieldError("sectors.withTarget", std::to_string(test.targetSectors),
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

SectorRounds visitSectorsOf(const ScanTest &test, Index fixedSize, const RunContext &context)
{
    const auto source = [&](const SectorVisit &visit) {
        return scanStages(
            test, {holdsTarget(test, visit.sector), firstLook + int(visit.round * test.sectors + visit.sector)});
    };
    return visitSectors(scanModel(test.scene, test.designSnrDb), test.sprt,
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

std::vector<double> curveSnrs(const ScanTest &test)
{
    std::vector<double> snrs;
    for (double step = -12.0; step <= 4.0; step += 2.0)
        if (!test.designFollows || test.designSnrDb + step <= highestDesignDb)
            snrs.push_back(test.designSnrDb + step);
    return snrs;
}

ScanPoint measureScanPoint(const ScanTest &test, double snrDb, const ScanPoint *before, const RunContext &context)
{
    ScanPoint point;
    point.snrDb = snrDb;
    point.designSnrDb = test.designFollows ? snrDb : test.designSnrDb;
    const bool isKnown = before && before->designSnrDb == point.designSnrDb;
    point.bounds = isKnown ? before->bounds
                           : waldBounds(test.sprt, ratioFromDb(point.designSnrDb), int(scanGrid(test.scene).size()));
    point.h0 = isKnown ? before->h0 : simulate(studyOf(test, point.designSnrDb, {}), context.part(0.0, 0.5));
    SequentialStudy study = studyOf(test, point.designSnrDb, snrDb);
    study.seed += std::uint64_t(1) << 32; // not the noise of H0 again
    point.h1 = simulate(study, context.part(0.5, 1.0));
    return point;
}

Chart stagesChart(std::vector<ScanPoint> points)
{
    Chart chart{"Stages against the SNR", "true SNR (dB)", "average sample number (stages)", false, false, {}};
    if (points.empty())
        return chart;
    sortBySnr(points);
    chart.curves = measured(points, &SequentialOutcome::stages);
    for (const Bound &bound : bounds)
        chart.curves.push_back(boundCurve(points, bound));
    return chart;
}

Chart variationChart(std::vector<ScanPoint> points)
{
    Chart chart{"Their coefficient of variation", "true SNR (dB)", "standard deviation / mean", false, false, {}};
    if (points.empty())
        return chart;
    sortBySnr(points);
    chart.curves = measured(points, &SequentialOutcome::variation);
    return chart;
}

PriorCurve startPriorCurve(const ScanTest &test)
{
    PriorCurve curve;
    curve.cells = std::min(test.scene.rangeCells, 1000);
    curve.bounds = waldBounds(test.sprt, ratioFromDb(test.designSnrDb), curve.cells);
    return curve;
}

const std::vector<double> &priorDeviations()
{
    static const std::vector<double> deviations{0.0, 0.3, 0.5, 1.0, 2.0, 5.0, std::numeric_limits<double>::infinity()};
    return deviations;
}

PriorPoint measurePriorPoint(const ScanTest &test, const PriorCurve &curve, double deviation, const RunContext &context)
{
    const double snr = ratioFromDb(test.designSnrDb);
    SequentialStudy study;
    study.model = walkOnLine(curve.cells, deviation, snr);
    study.sprt = test.sprt;
    study.sprt.cutOffStage = 0;
    study.trials = test.trials;
    study.seed = std::uint64_t(test.scene.seed);
    PriorPoint point{deviation, relativeEntropyRate(curve.cells, deviation), {}, {}};
    point.h0 = simulate(study, context.part(0.0, 0.5));
    study.actualSnr = snr;
    study.seed += std::uint64_t(1) << 32;
    point.h1 = simulate(study, context.part(0.5, 1.0));
    return point;
}

Chart priorChart(const PriorCurve &curve)
{
    Chart chart{"Stages against the prior", "entropy rate / ln M", "average sample number (stages)", false, false, {}};
    if (curve.points.empty())
        return chart;
    Curve h0{onNoise, Curve::Kind::Measured, {}};
    Curve h1{withTarget, Curve::Kind::Measured, {}};
    for (const PriorPoint &point : curve.points) {
        h0.points.push_back(pointAt(point.entropyRate, point.h0.stages));
        h1.points.push_back(pointAt(point.entropyRate, point.h1.stages));
    }
    chart.curves = {std::move(h0), std::move(h1)};
    for (const Bound &bound : bounds) {
        const double value = curve.bounds.*bound.value;
        chart.curves.push_back({boundName(bound), Curve::Kind::Theory, {{0.0, value, {}}, {1.0, value, {}}}});
    }
    return chart;
}

std::optional<Overshoot> overshoot(const PriorCurve &curve)
{
    for (const PriorPoint &point : curve.points)
        if (point.entropyRate == 1.0)
            return Overshoot{point.h0.stages.value / curve.bounds.h0High - 1.0,
                             point.h1.stages.value / curve.bounds.h1High - 1.0};
    return {};
}

} // namespace faintline
