#include "evaluate/experiments/campaignCharts.h"
#include "evaluate/experiments/campaignCurve.h"
#include "support/test.h"

#include "evaluate/experiments/peers.h"
#include "evaluate/theory/theory.h"

#include <cmath>

using namespace faintline;

/// Campaigns as charts: one curve per detector, theory only where it holds.
class tst_campaignCharts : public QObject
{
    Q_OBJECT

private slots:
    void pdHasOneCurvePerDetectorAndTheory()
    {
        const Chart chart = pdChart(campaign());
        QCOMPARE(chart.curves.size(), std::size_t(3));
        QCOMPARE(chart.curves[0].name, std::string("integrator"));
        QCOMPARE(chart.curves[1].name, std::string("3 of 4"));
        QCOMPARE(chart.curves[0].points.size(), std::size_t(2));
        QCOMPARE(chart.curves[0].points[0].y, 0.5); // 3.5 exceeds three of the six blocks
        QCOMPARE(chart.curves[0].points[1].y, 1.0);
        QVERIFY(chart.curves[0].points[0].interval.contains(0.5));
        QVERIFY(chart.curves[2].kind == Curve::Kind::Theory);
        // 100 windows of 150 × 50 independent cells.
        QCOMPARE(chart.curves[2].points.front().y, pdOfMeanPower(thresholdOfMeanPower(100.0 / 7500.0, 100), 100, 1.0));
        QCOMPARE(chart.curves[2].points.back().x, 3.0);
    }

    void theoryOnlyWhereItHolds()
    {
        const auto curvesWith = [](auto change) {
            Campaign changed = campaign();
            change(changed.experiment);
            return pdChart(changed).curves.size();
        };
        QCOMPARE(curvesWith([](Experiment &) {}), std::size_t(3));
        QCOMPARE(curvesWith([](Experiment &lines) { lines.wanderHz = 1.0; }), std::size_t(2));
        QCOMPARE(curvesWith([](Experiment &lines) { lines.fading = Fading::Rayleigh; }), std::size_t(2));
        QCOMPARE(curvesWith([](Experiment &lines) { lines.durationSeconds = 50.0; }), std::size_t(2));
        QCOMPARE(curvesWith([](Experiment &lines) { lines.window = WindowShape::Hann; }), std::size_t(2));
        // Frames that overlap two windows hold parts of two powers.
        QCOMPARE(curvesWith([](Experiment &lines) { lines.fluctuation = Fluctuation::Swerling2; }), std::size_t(2));
        QCOMPARE(curvesWith([](Experiment &lines) {
                     lines.fluctuation = Fluctuation::Swerling2;
                     lines.stepsPerWindow = 1;
                 }),
                 std::size_t(3));
    }

    void theoryOfFluctuatingLines()
    {
        Campaign changed = campaign();
        changed.experiment.fluctuation = Fluctuation::Swerling3;
        const Curve theory = pdChart(changed).curves.at(2);
        QCOMPARE(theory.name, std::string("integrator, Swerling 3"));
        QCOMPARE(theory.points.front().y,
                 pdOfMeanPower(thresholdOfMeanPower(100.0 / 7500.0, 100), 100, 1.0, Fluctuation::Swerling3));
        QCOMPARE(rocChart(changed, 0).curves.at(2).name, std::string("integrator, Swerling 3"));
    }

    void rocRisesWithFalseAlarms()
    {
        const Chart chart = rocChart(campaign(), 0);
        QVERIFY(chart.isLogarithmicX);
        QCOMPARE(chart.curves.size(), std::size_t(3));
        for (const Curve &curve : chart.curves) {
            QVERIFY(!curve.points.empty());
            for (std::size_t i = 1; i < curve.points.size(); ++i) {
                QVERIFY(curve.points[i].x > curve.points[i - 1].x);
                QVERIFY(curve.points[i].y >= curve.points[i - 1].y);
            }
        }
        // Threshold 5: one block of six exceeds it, no signal does. Threshold 3: three of six, and all signals.
        QCOMPARE(chart.curves[0].points.front().x, -std::log1p(-1.0 / 6.0));
        QCOMPARE(chart.curves[0].points.front().y, 0.0);
        QCOMPARE(chart.curves[0].points[2].y, 1.0);
    }

    void emptyCampaignsHaveEmptyCharts()
    {
        Campaign none = campaign();
        none.outcomes.clear();
        QVERIFY(pdChart(none).curves.empty());
        QVERIFY(rocChart(none, 1).curves.empty());
    }

    void shownThresholdIsExceededByItsShareOfBlocks()
    {
        Campaign one = campaign();
        // 1 - 1/e of six blocks is 3.8: four exceed 2, three exceed 3.
        QCOMPARE(shownThreshold(one, 0), 3.0);
        one.thresholds = {7.5, 8.5};
        QCOMPARE(shownThreshold(one, 1), 8.5);
    }

    void peersAreTheirOwnNames()
    {
        for (const DetectorUnderTest &one : peers(40.0))
            QCOMPARE(peer(one.name, 40.0), one);
        QVERIFY_EXCEPTION_THROWN(peer("none", 1.0), Error);
        QCOMPARE(std::get<IntegratorSettings>(peer("integrator", 40.0).settings.detector).durationWindows, 40.0);
    }

private:
    /// Two detectors, two SNRs, one run of six blocks: noise maxima 1 … 6, signals 3.5 throughout at 0 dB, 9 at 3 dB.
    static Campaign campaign()
    {
        Experiment lines{.trials = 1, .snrDb = {0.0, 3.0}};
        lines.detectors = {peer("integrator", lines.durationSeconds), peer("3 of 4", lines.durationSeconds)};
        RunOutcome outcome;
        outcome.noise.assign(2, {1, 2, 3, 4, 5, 6});
        outcome.signal.assign(2, {std::vector<float>(6, 3.5f), std::vector<float>(6, 9.0f)});
        return {lines, {}, {outcome}};
    }
};

FAINTLINE_TEST(tst_campaignCharts)
#include "tst_campaignCharts.moc"
