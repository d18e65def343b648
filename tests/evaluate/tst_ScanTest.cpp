#include "base/logmath.h"
#include "detect/averagedStages.h"
#include "detect/inspectStages.h"
#include "evaluate/sequential/ScanTest.h"
#include "evaluate/sequential/simulate.h"
#include "evaluate/theory/walkOnLine.h"
#include "support/test.h"

using namespace faintline;

namespace {

/// Small enough for hundreds of runs.
ScanTest smallTest()
{
    ScanTest test;
    test.sprt = {0.01, 0.02, 12};
    test.designSnrDb = 10.0;
    test.scene.snrDb = 10.0;
    test.scene.azimuthCells = 2;
    test.scene.elevationCells = 1;
    test.scene.rangeCells = 12;
    test.scene.dopplerCells = 3;
    test.trials = 200;
    return test;
}

} // namespace

/// A radar's test on simulated scans: the same world run by run and abreast, what it thought, what the sectors cost.
class tst_ScanTest : public QObject
{
    Q_OBJECT

private slots:
    void runsAreThoseThatAreSimulated_data()
    {
        QTest::addColumn<bool>("hasTarget");
        QTest::newRow("noise") << false;
        QTest::newRow("target") << true;
    }

    void runsAreThoseThatAreSimulated()
    {
        // Runs one by one and trials abreast have other random numbers; their means must agree.
        QFETCH(bool, hasTarget);
        const ScanTest test = smallTest();
        const SequentialModel model = scanModel(test.scene, test.designSnrDb);
        constexpr int runs = 400;
        double sum = 0.0;
        double squares = 0.0;
        int accepted = 0;
        for (int run = 0; run < runs; ++run) {
            const SprtResult result = walkScan(test, model, {hasTarget, run});
            const auto stages = double(result.stages);
            sum += stages;
            squares += stages * stages;
            accepted += result.decision == SprtDecision::H1 ? 1 : 0;
            QVERIFY(result.decision != SprtDecision::Undecided);
        }
        const double mean = sum / runs;
        const double error = std::sqrt((squares / runs - mean * mean) / runs);
        SequentialStudy study =
            studyOf(test, test.designSnrDb, hasTarget ? std::optional(test.scene.snrDb) : std::nullopt);
        study.trials = 4000;
        const SequentialOutcome outcome = simulate(study);
        QVERIFY(std::abs(mean - outcome.stages.value) < 4.5 * std::hypot(error, outcome.stages.standardError));
        const double p = double(outcome.acceptedH1) / 4000.0;
        const double spread = std::sqrt(std::max(p * (1.0 - p), 1e-3) * (1.0 / runs + 1.0 / 4000.0));
        QVERIFY(std::abs(double(accepted) / runs - p) < 4.5 * spread);
    }

    void noModelLosesProbability()
    {
        // Of no evidence ln Λ is 0 at all stages, whatever a scene says of the moves: E0[Λ_k] = 1.
        const auto check = [](const SequentialModel &model) {
            LikelihoodRatio ratio(model);
            const std::vector<double> lambda(std::size_t(model.reduction.stateCells()), 0.0);
            for (int stage = 0; stage < 100; ++stage)
                QVERIFY2(std::abs(ratio.update(lambda)) < 1e-12,
                         qPrintable(QString("stage %1: %2").arg(stage).arg(ratio.lnLambda())));
        };
        ScanScene scene = smallTest().scene;
        for (const int cells : {1, 3})
            for (const ScanMoves moves : {ScanMoves::Uniform, ScanMoves::Gaussian})
                for (const double deviation : {0.0, 0.7, 30.0}) {
                    scene.elevationCells = cells;
                    scene.moves = moves;
                    scene.moveCells = deviation;
                    check(scanModel(scene, 10.0));
                }
        for (const double deviation : priorDeviations())
            check(walkOnLine(30, deviation, 1.0));
    }

    void aRunIsMadeAgain()
    {
        const ScanTest test = smallTest();
        const SequentialModel model = scanModel(test.scene, test.designSnrDb);
        const ScanRun run{true, 7};
        const SprtResult first = walkScan(test, model, run);
        QVERIFY(walkScan(test, model, run).lnLambda == first.lnLambda);
        const InspectedTest again = inspectStages(model, test.sprt, stageLimit(test), scanStages(test, run));
        QVERIFY(again.result.lnLambda == first.lnLambda);
        QVERIFY(again.result.trajectory == first.trajectory);
        QVERIFY(walkScan(test, model, {true, 8}).lnLambda != first.lnLambda);
        QCOMPARE(std::ssize(truthOf(test, run)), stageLimit(test));
        QVERIFY(truthOf(test, {false, 7}).empty());
    }

    void theHypothesesDoNotShareTheirNoise()
    {
        const ScanTest test = smallTest();
        std::vector<double> noise(72);
        std::vector<double> target(72);
        scanStages(test, {false, 3})(0, noise);
        scanStages(test, {true, 3})(0, target);
        int same = 0;
        for (std::size_t i = 0; i < noise.size(); ++i)
            same += noise[i] == target[i] ? 1 : 0;
        QVERIFY(same < 3);
    }

    void thePosteriorIsTheRatios()
    {
        const ScanTest test = smallTest();
        const SequentialModel model = scanModel(test.scene, test.designSnrDb);
        const InspectedTest inspected = inspectStages(model, test.sprt, stageLimit(test), scanStages(test, {true, 1}));
        QCOMPARE(inspected.posterior.size(), std::size_t(3));
        QCOMPARE(inspected.posterior[2].name, std::string("range"));
        QCOMPARE(inspected.posterior[2].frameAxis, std::size_t(2));
        const PosteriorPicture &range = inspected.posterior[2];
        QCOMPARE(range.rows(), inspected.result.stages);

        // By hand: fold Doppler, update, sum over azimuth.
        const StageSource source = scanStages(test, {true, 1});
        LikelihoodRatio ratio(model);
        std::vector<double> y(72);
        std::vector<double> folded(24);
        for (Index stage = 0; stage < range.rows(); ++stage) {
            source(stage, y);
            for (std::size_t cell = 0; cell < 24; ++cell) {
                double sum = 0.0;
                for (std::size_t d = 0; d < 3; ++d)
                    sum += std::exp(model.markov.likelihood.at(y[3 * cell + d])) / 3.0;
                folded[cell] = std::log(sum);
            }
            ratio.update(folded);
            double total = 0.0;
            for (std::size_t cell = 0; cell < 12; ++cell) {
                const double p = ratio.posterior()[cell] + ratio.posterior()[12 + cell];
                const auto got = double(range.probability[std::size_t(stage) * 12 + cell]);
                QVERIFY(std::abs(got - p) < 1e-6);
                total += got;
            }
            QVERIFY(std::abs(total - 1.0) < 1e-5);
        }
    }

    void longPicturesAreThinned()
    {
        // 5000 cells, more stages than 2²² values hold, never decided: every row left is the one its stage had.
        KinematicAxis axis;
        axis.cells = 5000;
        const SequentialModel model =
            makeSequentialModel({axis}, {false}, Likelihood(LikelihoodKind::Exponential, 0.1));
        const StageSource source = [](Index stage, std::span<double> y) {
            std::fill(y.begin(), y.end(), 1.04);
            y[std::size_t(stage)] = 1.2;
        };
        const InspectedTest inspected = inspectStages(model, {1e-9, 1e-9, 0}, 1000, source);
        const PosteriorPicture &picture = inspected.posterior[0];
        QVERIFY(inspected.result.decision == SprtDecision::Undecided);
        QCOMPARE(picture.stride, Index(2));
        QCOMPARE(picture.rows(), Index(500));
        QVERIFY(picture.probability.size() <= std::size_t(1) << 22);
        for (const Index row : {Index(0), Index(1), Index(250), Index(499)}) {
            const float *cells = picture.probability.data() + row * 5000;
            QVERIFY(cells[2 * row] > cells[2 * row + 1]); // seen at that stage, its neighbour not yet
        }
    }

    void averagedStagesAreTheStudys()
    {
        // Doppler folded: rows of range lie strided on a scan, and block by block in a study's trial.
        ScanTest test = smallTest();
        test.averagedCells = 6;
        const SequentialModel model = scanModel(test.scene, test.designSnrDb);
        std::vector<double> plain(72);
        std::vector<double> averaged(72);
        ScanTest known = test;
        known.averagedCells = 0;
        scanStages(known, {true, 2})(4, plain);
        scanStages(test, {true, 2})(4, averaged);
        const double snr = ratioFromDb(10.0);
        for (std::size_t row = 0; row < 2; ++row)
            for (std::size_t d = 0; d < 3; ++d)
                for (std::size_t i = 0; i < 12; ++i) {
                    const std::size_t begin = std::min<std::size_t>(i < 3 ? 0 : i - 3, 12 - 7);
                    double neighbours = 0.0;
                    for (std::size_t j = begin; j < begin + 7; ++j)
                        neighbours += j == i ? 0.0 : plain[(row * 12 + j) * 3 + d];
                    const double t = plain[(row * 12 + i) * 3 + d] / (neighbours / 6.0);
                    const double y =
                        7.0 * (1.0 + snr) / snr * std::log((1.0 + t / 6.0) / (1.0 + t / (6.0 * (1.0 + snr))));
                    QVERIFY(std::abs(averaged[(row * 12 + i) * 3 + d] - y) < 1e-4 * (1.0 + y));
                }
    }

    void anAverageKnowsNoPower()
    {
        const ScanTest test = smallTest();
        const SequentialModel model = scanModel(test.scene, test.designSnrDb);
        const StageSource plain = scanStages(test, {true, 5});
        const StageSource loud = [plain](Index stage, std::span<double> y) {
            plain(stage, y);
            for (double &value : y)
                value *= 64.0;
        };
        const SprtResult a = runSprt(model, test.sprt, 12, averagedStages(plain, model, 8, "average"));
        const SprtResult b = runSprt(model, test.sprt, 12, averagedStages(loud, model, 8, "average"));
        QVERIFY(a.lnLambda == b.lnLambda); // a power of two changes no digit
    }

    void averagesThatCannotBe_data()
    {
        QTest::addColumn<int>("world");
        QTest::addColumn<int>("cells");
        QTest::newRow("none") << 0 << 0;
        QTest::newRow("negative") << 0 << -2;
        QTest::newRow("as many as the row") << 0 << 12;
        QTest::newRow("all folded") << 1 << 1;
        QTest::newRow("another law") << 2 << 4;
    }

    void averagesThatCannotBe()
    {
        QFETCH(int, world);
        QFETCH(int, cells);
        KinematicAxis axis;
        axis.cells = 12;
        const Likelihood likelihood(world == 2 ? LikelihoodKind::Rice : LikelihoodKind::Exponential, 1.0);
        const SequentialModel model = makeSequentialModel({axis}, {world == 1}, likelihood);
        QVERIFY_THROWS_EXCEPTION(Error, averagedStages([](Index, std::span<double>) {}, model, cells, "average"));
    }

    void sectorsWithTargetsAreFound()
    {
        ScanTest test = smallTest();
        test.scene.snrDb = test.designSnrDb = 16.0;
        test.sectors = 5;
        test.targetSectors = 1;
        test.rounds = 20;
        const SectorRounds made = visitSectorsOf(test, 4);
        QCOMPARE(made.visits.size(), std::size_t(100));
        QCOMPARE(made.fixedStages, Index(400));
        int found = 0;
        int wrong = 0;
        Index stages = 0;
        for (const SectorVisit &visit : made.visits) {
            const bool isAccepted = visit.result.decision == SprtDecision::H1;
            (holdsTarget(test, visit.sector) ? found : wrong) += isAccepted ? 1 : 0;
            QCOMPARE(visit.firstStage, stages);
            stages += visit.result.stages;
        }
        QVERIFY(found >= 17); // expected 19.6 of 20
        QVERIFY(wrong <= 5);  // expected 0.8 of 80 at most
    }

    void targetsAreSpreadOverTheSectors()
    {
        ScanTest test;
        for (const int sectors : {1, 2, 12, 37})
            for (int targets = 0; targets <= sectors; ++targets) {
                test.sectors = sectors;
                test.targetSectors = targets;
                int count = 0;
                for (Index sector = 0; sector < sectors; ++sector)
                    count += holdsTarget(test, sector) ? 1 : 0;
                QCOMPARE(count, targets);
            }
    }

    void curvesCarryTheirBounds()
    {
        const ScanTest test = smallTest();
        QCOMPARE(curveSnrs(test).size(), std::size_t(9));
        const ScanPoint first = measureScanPoint(test, 10.0);
        const ScanPoint second = measureScanPoint(test, 0.0, &first);
        QCOMPARE(second.h0.stages.value, first.h0.stages.value); // one design: one test on noise
        QVERIFY(second.h1.stages.value > first.h1.stages.value);
        const WaldBounds bounds = waldBounds(test.sprt, 10.0, 72);
        QVERIFY(std::abs(first.bounds.h0High - bounds.h0High) < 1e-9);
        QVERIFY(first.h0.stages.value > bounds.h0Low);

        const Chart chart = stagesChart({first, second});
        QCOMPARE(chart.curves.size(), std::size_t(6));
        QCOMPARE(chart.curves[1].points[0].x, 0.0); // sorted
        QCOMPARE(chart.curves[1].points[1].y, first.h1.stages.value);
        for (std::size_t i = 2; i < 6; ++i)
            QVERIFY(chart.curves[i].name.starts_with(chart.curves[i < 4 ? 0 : 1].name));
        QCOMPARE(chart.curves[5].points[0].y, bounds.h1High);
        QVERIFY(chart.curves[5].points[0].x > 9.0 && chart.curves[5].points[1].x < 11.0); // at the design SNR alone
        QCOMPARE(variationChart({first, second}).curves.size(), std::size_t(2));
        QVERIFY(stagesChart({}).curves.empty());
    }

    void theDesignFollows()
    {
        ScanTest test = smallTest();
        test.designFollows = true;
        const ScanPoint strong = measureScanPoint(test, 14.0);
        const ScanPoint weak = measureScanPoint(test, 6.0, &strong);
        QVERIFY(weak.h0.stages.value > strong.h0.stages.value);
        QVERIFY(weak.bounds.h0High > strong.bounds.h0High);
        QCOMPARE(stagesChart({strong, weak}).curves[5].points[0].x, 6.0);
    }

    void thePriorGoesFromKnownToUnknown()
    {
        ScanTest test = smallTest();
        test.designSnrDb = 0.0;
        test.trials = 2000;
        PriorCurve curve = startPriorCurve(test);
        QCOMPARE(curve.cells, 12);
        QVERIFY(!overshoot(curve));
        for (const double deviation : {priorDeviations().front(), 1.0, priorDeviations().back()})
            curve.points.push_back(measurePriorPoint(test, curve, deviation));
        QCOMPARE(curve.points[0].entropyRate, 0.0);
        QVERIFY(curve.points[1].entropyRate > 0.0 && curve.points[1].entropyRate < 1.0);
        QCOMPARE(curve.points[2].entropyRate, 1.0);
        const DeterministicSprt exact = deterministicSprt({0.01, 0.02, 0}, 1.0, 1.0);
        const PriorPoint &known = curve.points[0];
        QVERIFY(std::abs(known.h0.stages.value - exact.h0.meanStages) < 4.5 * known.h0.stages.standardError);
        QVERIFY(std::abs(known.h1.stages.value - exact.h1.meanStages) < 4.5 * known.h1.stages.standardError);
        for (const auto hypothesis : {&PriorPoint::h0, &PriorPoint::h1}) {
            QVERIFY((curve.points[0].*hypothesis).stages.value < (curve.points[1].*hypothesis).stages.value);
            QVERIFY((curve.points[1].*hypothesis).stages.value < (curve.points[2].*hypothesis).stages.value);
        }
        const std::optional<Overshoot> over = overshoot(curve);
        QVERIFY(over);
        QCOMPARE(over->h1, curve.points[2].h1.stages.value / curve.bounds.h1High - 1.0);
        QCOMPARE(priorChart(curve).curves.size(), std::size_t(6));
    }

    void entropyOfTheWalk()
    {
        QCOMPARE(relativeEntropyRate(10, 0.0), 0.0);
        QCOMPARE(relativeEntropyRate(1, 3.0), 0.0);
        QVERIFY(relativeEntropyRate(10, 1e6) > 0.999); // as good as uniform
        QVERIFY(relativeEntropyRate(10, 1.0) > relativeEntropyRate(100, 1.0));
    }

    void namesOfEarlierVersionsAreRead()
    {
        ScanTest test;
        setScanTestField(test, "survey.sectors=8");
        setScanTestField(test, "sectors.rounds=3");
        QCOMPARE(test.sectors, 8);
        QCOMPARE(test.rounds, 3);
        Json json = writeFields(test, ScanTest::fields());
        QCOMPARE(scanTestFromJson(json, "test"), test);
        json.erase("sectors.count");
        json["survey.sectors"] = 8;
        QCOMPARE(scanTestFromJson(json, "test"), test);
        QCOMPARE(scanTestField("survey.targetSectors"), scanTestField("sectors.withTarget"));
        QVERIFY(!scanTestField("survey.unknown"));
    }

    void refusals_data()
    {
        QTest::addColumn<QString>("member");
        for (const char *name : {"sprt.falseAlarm", "sprt.cutOffStage", "scene.rangeCells", "design.averagedCells",
                                 "sectors.withTarget", "runs.walks"})
            QTest::newRow(name) << name;
    }

    void refusals()
    {
        QFETCH(QString, member);
        ScanTest test;
        checkScanTest(test);
        if (member == "sprt.falseAlarm")
            test.sprt.falseAlarm = 0.0;
        else if (member == "sprt.cutOffStage")
            test.sprt.cutOffStage = 100000;
        else if (member == "scene.rangeCells")
            test.scene.rangeCells = 1 << 20;
        else if (member == "design.averagedCells")
            test.averagedCells = 100;
        else if (member == "sectors.withTarget")
            test.targetSectors = 13;
        else
            test.walks = 0;
        try {
            checkScanTest(test);
            QFAIL("accepted");
        } catch (const Error &error) {
            QVERIFY2(error.where().find(member.toStdString()) == 0, error.what());
        }
    }
};

FAINTLINE_TEST(tst_ScanTest)
#include "tst_ScanTest.moc"
