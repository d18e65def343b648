#include "base/logmath.h"
#include "evaluate/sequential/SequentialTrial.h"
#include "evaluate/sequential/simulate.h"
#include "evaluate/theory/waldTheory.h"
#include "support/studies.h"
#include "support/test.h"

#include <map>

using namespace faintline;
using test::axis;

namespace {

KinematicAxis walk(Index cells, double deviation)
{
    KinematicAxis a = axis(cells, gaussianStep(deviation, cells));
    a.renormalised = true;
    return a;
}

SequentialStudy study(const std::vector<KinematicAxis> &axes, const std::vector<bool> &isFolded, double snr,
                      std::optional<double> actual, Index trials)
{
    SequentialStudy made = test::study(axes, isFolded, snr, actual);
    made.sprt = {0.01, 0.02, 0};
    made.trials = trials;
    return made;
}

/// The trial's frames in the order of the model's frame: folded axes are the last ones here.
StageSource stagesOf(const SequentialStudy &made, SequentialTrial &trial)
{
    return [&](Index, std::span<double> y) {
        const std::span<const float> blocks = trial.next();
        const auto cells = std::size_t(made.model.reduction.stateCells());
        const std::size_t folded = blocks.size() / cells;
        for (std::size_t i = 0; i < blocks.size(); ++i)
            y[i % cells * folded + i / cells] = double(blocks[i]);
    };
}

} // namespace

/// Simulated tests: exact where theory is, the same trials as the plain test takes, nothing that depends on threads.
class tst_simulate : public QObject
{
    Q_OBJECT

private slots:
    void isTheExactWalk_data()
    {
        QTest::addColumn<bool>("isTarget");
        QTest::addColumn<double>("actualDb");
        QTest::newRow("noise") << false << 0.0;
        QTest::newRow("as designed for") << true << 3.0;
        QTest::newRow("weaker") << true << 0.0;
    }

    void isTheExactWalk()
    {
        QFETCH(bool, isTarget);
        QFETCH(double, actualDb);
        const double design = ratioFromDb(3.0);
        const SequentialStudy made =
            study({axis(1)}, {false}, design, isTarget ? std::optional(ratioFromDb(actualDb)) : std::nullopt, 20000);
        const SequentialOutcome outcome = simulate(made);
        const DeterministicSprt exact = deterministicSprt(made.sprt, design, ratioFromDb(actualDb));
        const DeterministicSprt::Law &law = isTarget ? exact.h1 : exact.h0;
        QVERIFY(std::abs(outcome.stages.value - law.meanStages) < 4.0 * outcome.stages.standardError);
        QVERIFY(std::abs(outcome.deviationStages / law.deviationStages - 1.0) < 0.05);
        QVERIFY(std::abs(outcome.variation.value - law.deviationStages / law.meanStages)
                < 4.0 * outcome.variation.standardError);
        const double p = double(outcome.acceptedH1) / 20000.0;
        QVERIFY(std::abs(p - law.acceptH1) < 4.0 * std::sqrt(law.acceptH1 * (1.0 - law.acceptH1) / 20000.0));
        Index counted = 0;
        for (const Index n : outcome.stopCounts)
            counted += n;
        QCOMPARE(counted, outcome.trials);
    }

    void isThePlainTest_data()
    {
        QTest::addColumn<int>("world");
        QTest::addColumn<bool>("isTarget");
        for (const int world : {0, 1, 2, 3, 4})
            for (const bool isTarget : {false, true})
                QTest::addRow("world %d, %s", world, isTarget ? "target" : "noise") << world << isTarget;
    }

    void isThePlainTest()
    {
        // Abreast, unscaled and with ratios in single precision, or one by one as runSprt does it: the same decisions.
        QFETCH(int, world);
        QFETCH(bool, isTarget);
        const std::optional<double> actual = isTarget ? std::optional(2.0) : std::nullopt;
        KinematicAxis rated = axis(7);
        rated.cyclic = true;
        rated.firstRate = -1;
        rated.rateCount = 3;
        rated.rateChange = {0.5, 0.25};
        if (world == 4) {
            rated.cyclic = false;
            rated.ratesPerCell = 3;
        }
        SequentialStudy made = world == 0 ? study({walk(9, 1.0)}, {false}, 2.0, actual, 60)
                               : world == 1
                                   ? study({walk(3, 0.6), walk(4, 1.0), axis(3)}, {false, false, true}, 2.0, actual, 60)
                               : world == 2 ? study({axis(6)}, {true}, 2.0, actual, 60)
                                            : study({rated}, {false}, 2.0, actual, 60);
        made.sprt.cutOffStage = 40;
        const SequentialOutcome outcome = simulate(made);
        const TrajectorySampler sampler(made.model);
        std::vector<Index> stopCounts(40, 0);
        Index acceptedH1 = 0;
        for (Index number = 0; number < made.trials; ++number) {
            SequentialTrial trial(made, sampler, number);
            const StageSource source = stagesOf(made, trial);
            // Of the stages asked for a second time only the decision is looked at here.
            std::vector<std::vector<double>> taken;
            const SprtResult result = runSprt(made.model, made.sprt, 40, [&](Index stage, std::span<double> y) {
                if (stage == std::ssize(taken)) {
                    source(stage, y);
                    taken.emplace_back(y.begin(), y.end());
                }
                std::copy(taken[std::size_t(stage)].begin(), taken[std::size_t(stage)].end(), y.begin());
            });
            acceptedH1 += result.decision == SprtDecision::H1 ? 1 : 0;
            ++stopCounts[std::size_t(result.stages - 1)];
        }
        QCOMPARE(outcome.acceptedH1, acceptedH1);
        stopCounts.resize(outcome.stopCounts.size());
        QCOMPARE(outcome.stopCounts, stopCounts);
    }

    void threadsChangeNothing()
    {
        SequentialStudy made = study({walk(6, 1.0)}, {false}, 4.0, 4.0, 3500); // several pieces of work
        made.estimatesTrajectory = true;
        RunContext three;
        three.threads = 3;
        const SequentialOutcome a = simulate(made);
        const SequentialOutcome b = simulate(made, three);
        QCOMPARE(a.stages.value, b.stages.value);
        QCOMPARE(a.otherError.value, b.otherError.value);
        QCOMPARE(a.stopCounts, b.stopCounts);
        QCOMPARE(a.correctTrack, b.correctTrack);
    }

    void errorsAreKept_data()
    {
        QTest::addColumn<int>("reach");
        QTest::addColumn<std::vector<double>>("law");
        QTest::addColumn<bool>("isCyclic");
        const std::vector<double> third{1.0 / 3.0, 1.0 / 3.0};
        QTest::newRow("five slopes between ends") << 2 << third << false;
        QTest::newRow("five slopes round a ring") << 2 << third << true;
        QTest::newRow("inertia") << 2 << std::vector<double>{0.9, 0.05} << false;
        QTest::newRow("17 slopes of 1/8 with inertia") << 8 << std::vector<double>{0.9, 0.05} << false;
        QTest::newRow("slopes that are kept") << 1 << std::vector<double>{1.0} << false;
    }

    void errorsAreKept()
    {
        // α = β = 1e-3, 0 dB, targets from the model's own law: at most three wrong of a thousand runs of either kind.
        QFETCH(int, reach);
        QFETCH(std::vector<double>, law);
        QFETCH(bool, isCyclic);
        KinematicAxis slopes = axis(41);
        slopes.firstRate = -reach;
        slopes.rateCount = 2 * reach + 1;
        slopes.rateChange = law;
        slopes.ratesPerCell = reach > 2 ? reach : 1;
        slopes.cyclic = isCyclic;
        SequentialStudy made = study({slopes}, {false}, 1.0, std::nullopt, 1000);
        made.sprt = {1e-3, 1e-3, 0};
        const SequentialOutcome noise = simulate(made);
        QCOMPARE(noise.undecided, Index(0));
        QVERIFY2(noise.acceptedH1 <= 3, qPrintable(QString::number(noise.acceptedH1)));
        made.actualSnr = 1.0;
        made.seed = 2;
        const SequentialOutcome targets = simulate(made);
        QCOMPARE(targets.undecided, Index(0));
        QVERIFY2(targets.acceptedH1 >= 997, qPrintable(QString::number(1000 - targets.acceptedH1)));
    }

    void targetsFollowTheLaw_data()
    {
        QTest::addColumn<int>("kind");
        QTest::newRow("Gaussian walk") << 0;
        QTest::newRow("matrix") << 1;
        QTest::newRow("cyclic walk") << 2;
        QTest::newRow("rates") << 3;
        QTest::newRow("rates between ends") << 4;
        QTest::newRow("walk that loses") << 5;
        QTest::newRow("rates of half a cell between ends") << 6;
    }

    void targetsFollowTheLaw()
    {
        QFETCH(int, kind);
        KinematicAxis a = kind == 0 ? walk(4, 0.8) : axis(4);
        if (kind == 1)
            a.transition = {0.5, 0.5, 0, 0, 0.1, 0.2, 0.3, 0.4, 0, 0, 1, 0, 0.25, 0.25, 0.25, 0.25};
        if (kind == 2) {
            a.step = {0.4, 0.3};
            a.cyclic = true;
        }
        if (kind == 5)
            a.step = {0.4, 0.3};
        if (kind == 3 || kind == 4 || kind == 6) {
            a.cyclic = kind == 3;
            a.ratesPerCell = kind == 6 ? 2 : 1;
            a.firstRate = -1;
            a.rateCount = 3;
            a.rateChange = {0.6, 0.2};
        }
        const SequentialModel model = makeSequentialModel({a}, {false}, Likelihood(LikelihoodKind::Exponential, 1.0));
        const TrajectorySampler sampler(model);
        const StateSpace &space = model.markov.space;
        std::map<std::array<Index, 3>, double> counts;
        std::map<std::pair<Index, Index>, double> leaving;
        Random random(8, 8);
        for (int run = 0; run < 400; ++run) {
            Index state = sampler.first(random);
            for (Index step = 0; step < 100; ++step) {
                const Index phase = step % space.phaseCount();
                const Index next = sampler.next(state, random, step);
                ++counts[{phase, state, next}];
                ++leaving[{phase, state}];
                state = next;
            }
        }
        for (Index phase = 0; phase < space.phaseCount(); ++phase)
            for (Index to = 0; to < space.stateCount(); ++to) {
                std::map<Index, double> law;
                for (const StateSpace::Predecessor &p : space.predecessors(to, phase))
                    law[p.state] += std::exp(p.lnProbability);
                for (Index from = 0; from < space.stateCount(); ++from) {
                    const double p = law[from];
                    const double n = leaving[{phase, from}];
                    const double error = std::sqrt(std::max(p * (1.0 - p), 0.0) * n);
                    QVERIFY(std::abs(counts[{phase, from, to}] - p * n) <= 4.5 * error + 1e-9);
                }
            }
    }

    void changeOfMeasureAgreesWithCounting()
    {
        const SequentialStudy noise = study({walk(5, 1.0)}, {false}, 2.0, std::nullopt, 20000);
        SequentialStudy target = noise;
        target.actualSnr = 2.0;
        target.seed = 2;
        const SequentialOutcome onNoise = simulate(noise);
        const SequentialOutcome withTarget = simulate(target);
        const auto agrees = [](Index wrong, const Estimate &other) {
            const double p = double(wrong) / 20000.0;
            return std::abs(p - other.value) < 4.0 * std::hypot(std::sqrt(p / 20000.0), other.standardError);
        };
        QVERIFY(onNoise.acceptedH1 > 30); // enough to compare
        QVERIFY(agrees(onNoise.acceptedH1, withTarget.otherError));
        QVERIFY(agrees(20000 - withTarget.acceptedH1, onNoise.otherError));
        // Wald's inequalities.
        QVERIFY(withTarget.otherError.value <= std::exp(-sprtBoundaries(noise.sprt).lnUpper));
        QVERIFY(onNoise.otherError.value <= std::exp(sprtBoundaries(noise.sprt).lnLower));
    }

    void strongTargetsAreFollowed()
    {
        SequentialStudy made = study({walk(20, 0.5)}, {false}, 1e4, 1e4, 300);
        made.estimatesTrajectory = true;
        const SequentialOutcome outcome = simulate(made);
        QVERIFY(outcome.acceptedH1 >= 290);
        QVERIFY(outcome.correctTrack >= outcome.acceptedH1 - 3);
        QVERIFY(outcome.correctLast >= outcome.correctTrack - 3);
    }

    void cutOffEndsAll()
    {
        SequentialStudy made = study({walk(10, 1.0)}, {false}, 1.0, std::nullopt, 500);
        made.sprt.cutOffStage = 3;
        const SequentialOutcome outcome = simulate(made);
        QCOMPARE(std::ssize(outcome.stopCounts), Index(3));
        QCOMPARE(outcome.undecided, Index(0));
    }

    void averagedNoiseKeepsItsErrors()
    {
        // The exact likelihood ratio of a cell over its neighbours' mean: for one cell among many α and β hold as ever.
        SequentialStudy made = study({axis(40)}, {false}, 6.0, std::nullopt, 3000);
        made.averagedCells = 16;
        const SequentialOutcome averaged = simulate(made);
        QVERIFY(double(averaged.acceptedH1) / 3000.0 < 0.01 + 4.0 * std::sqrt(0.01 / 3000.0));
        made.averagedCells = 0;
        QVERIFY(averaged.stages.value > simulate(made).stages.value); // not to know the noise costs stages
    }

    void fixedSize()
    {
        // A known trajectory has an exact answer.
        SequentialStudy made = study({axis(1)}, {false}, 6.0, std::nullopt, 20000);
        made.sprt = {0.01, 0.05, 0};
        const std::optional<Index> found = simulatedFixedSampleSize(made, 20);
        QVERIFY(found);
        QVERIFY(std::abs(*found - fixedSampleSize(made.sprt, 6.0)) <= 1);
        QVERIFY(!simulatedFixedSampleSize(made, 1));
    }

    void refusals()
    {
        SequentialStudy made = study({axis(4)}, {false}, 1.0, std::nullopt, 10);
        made.averagedCells = 4;
        QVERIFY_EXCEPTION_THROWN(simulate(made), Error);
        made.averagedCells = 0;
        made.actualSnr = -1.0;
        QVERIFY_EXCEPTION_THROWN(simulate(made), Error);
        made.actualSnr.reset();
        made.trials = 0;
        QVERIFY_EXCEPTION_THROWN(simulate(made), Error);
        RunContext stopped;
        std::stop_source source;
        source.request_stop();
        stopped.stop = source.get_token();
        made.trials = 10;
        QVERIFY_EXCEPTION_THROWN(simulate(made, stopped), Cancelled);
    }
};

FAINTLINE_TEST(tst_simulate)
#include "tst_simulate.moc"
