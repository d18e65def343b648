#include "reproduce/Reproduction.h"
#include "support/test.h"

#include "reproduce/grossiParts.h"
#include "reproduce/parsonsParts.h"
#include "reproduce/reproduce.h"
#include "support/errors.h"

#include <cmath>
#include <numbers>
#include <set>

using namespace faintline;
using namespace faintline::test;

namespace {

ReproducedCell cellWith(double ours, Interval interval, int judgedTogether = 1, int runs = 0)
{
    ReproducedCell cell;
    cell.ours = ours;
    cell.interval = interval;
    cell.judgedTogether = judgedTogether;
    cell.runs = runs;
    return cell;
}

/// The deviations that a joint interval reaches to either side of a cell with an interval of one standard error.
double reach(int judgedTogether, int runs)
{
    constexpr double errors = 1.959963984540054;
    const Interval joint = cellWith(0.0, {-errors, errors}, judgedTogether, runs).jointInterval();
    return joint.low == -joint.high ? joint.high : NAN;
}

double normalTail(double deviations)
{
    return 0.5 * std::erfc(deviations / std::numbers::sqrt2);
}

} // namespace

/// The verdict on a reproduced number: its interval by laws in closed form, its edges by hand.
class tst_Reproduction : public QObject
{
    Q_OBJECT

private slots:
    // 5 % of twenty seeds, on two sides: one of 1600 cells is left out where one is judged, one of 64 000 where forty are.
    void aJointIntervalMissesOnceInTwentySeeds()
    {
        QVERIFY(std::abs(normalTail(reach(1, 0)) - 0.00125) < 1e-12);
        QVERIFY(std::abs(normalTail(reach(40, 0)) - 0.00125 / 40.0) < 1e-14);
        QCOMPARE(reach(0, 0), reach(1, 0));
        QCOMPARE(reach(1, 1), reach(1, 0)); // a single run has no scatter
    }

    void fewRunsFollowStudentsLaw()
    {
        constexpr double tail = 0.00125;
        // One degree of freedom is Cauchy's law; that of two is algebraic.
        QVERIFY(std::abs(reach(1, 2) * std::tan(std::numbers::pi * tail) - 1.0) < 1e-9);
        QVERIFY(std::abs(reach(1, 3) / ((1.0 - 2.0 * tail) / std::sqrt(2.0 * tail * (1.0 - tail))) - 1.0) < 1e-9);
        QVERIFY(reach(1, 3) > reach(1, 4) && reach(1, 4) > reach(1, 100));
        QVERIFY(std::abs(reach(1, 1'000'000) - reach(1, 0)) < 1e-4);
    }

    void eachSideIsWidenedByItself()
    {
        const double widening = reach(1, 0) / 1.959963984540054;
        const Interval joint = cellWith(0.9, {0.7, 0.95}).jointInterval();
        QVERIFY(std::abs(joint.low - (0.9 - 0.2 * widening)) < 1e-12);
        QVERIFY(std::abs(joint.high - (0.9 + 0.05 * widening)) < 1e-12);
    }

    void insideByToleranceOrByInterval()
    {
        ReproducedCell cell = cellWith(1.0, {});
        QVERIFY(!cell.isJudged() && cell.isInside()); // nothing to be held against
        cell.reference = 1.25;
        QVERIFY(cell.isJudged() && !cell.isInside());
        cell.tolerance = 0.25;
        QVERIFY(cell.isInside()); // as far as it may be
        cell.tolerance = 0.2499;
        QVERIFY(!cell.isInside());
        cell.interval = {0.8, 1.2}; // alone it misses; 3.02 errors instead of 1.96 do not
        QVERIFY(cell.isInside());
        cell.reference = 1.32;
        QVERIFY(!cell.isInside());
        cell.judgedTogether = 40; // 4.0 errors
        QVERIFY(cell.isInside());
        Reproduction made;
        QVERIFY(made.isInside());
        made.cells = {cell, cell};
        QVERIFY(made.isInside());
        made.cells[1].reference = 2.0;
        QVERIFY(!made.isInside());
    }

    void deviationsFromThePaper()
    {
        constexpr double errors = 1.959963984540054;
        ReproducedCell cell = cellWith(5.0, {5.0 - 0.3 * errors, 5.0 + 0.3 * errors});
        QVERIFY(!cell.z()); // the paper has no figure
        cell.paper = 4.0;
        QVERIFY(std::abs(*cell.z() - 1.0 / 0.3) < 1e-9);
        cell.paperError = 0.4; // 0.3 and 0.4 make 0.5
        QVERIFY(std::abs(*cell.z() - 2.0) < 1e-9);
        cell.interval = {};
        QVERIFY(std::abs(*cell.z() - 2.5) < 1e-12);
        cell.paperError = 0.0;
        QVERIFY(!cell.z()); // neither figure has an error
    }

    void judgedCellsAreCounted()
    {
        Reproduction made;
        made.cells.resize(5);
        for (const std::size_t judged : {0u, 2u, 3u})
            made.cells[judged].reference = 0.5;
        judgeTogether(made);
        for (const ReproducedCell &cell : made.cells)
            QCOMPARE(cell.judgedTogether, 3);
    }

    void namesAreListedOnce()
    {
        std::set<std::string> names;
        for (const Reproducible &one : reproducibles()) {
            QVERIFY2(names.insert(one.name).second, one.name.c_str());
            QVERIFY2(!one.title.empty() && one.run, one.name.c_str());
            QCOMPARE(&reproducible(one.name), &one);
        }
        QVERIFY(names.size() >= 10);
    }

    void anUnknownNameIsToldTheKnownOnes()
    {
        const std::string words = errorOf([] { reproducible("billon:table9"); });
        QVERIFY2(contains(words, "billon:table9"), words.c_str());
        for (const Reproducible &one : reproducibles())
            QVERIFY2(contains(words, one.name), words.c_str());
    }

    void standardErrorsOfFrequencies()
    {
        QCOMPARE(frequencyError(0.5, 100.0), 0.05);
        QVERIFY(std::abs(frequencyError(0.2, 400.0) - 0.02) < 1e-15);
        // None and all are known no better than one that did, or did not.
        QCOMPARE(frequencyError(0.0, 100.0), std::sqrt(0.01 * 0.99 / 100.0));
        QCOMPARE(frequencyError(1.0, 100.0), frequencyError(0.0, 100.0));
        QCOMPARE(frequencyError(0.004, 100.0), frequencyError(0.01, 100.0));
    }

    void tolerancesAddUp()
    {
        QCOMPARE(toleranceOf(0.3, 0.4, 0.0), 2.0);
        QCOMPARE(toleranceOf(0.0, 0.0, 0.1), 0.05);
        QCOMPARE(toleranceOf(0.3, 0.4, 0.1), 2.05);
    }

    void cellsOfMeansAndFrequencies()
    {
        const ReproducedCell mean = measuredCell("σ = 1", "H0", {10.0, 0.4}, {11.0, 0.3, 0.1});
        QCOMPARE(mean.row, std::string("σ = 1"));
        QCOMPARE(mean.column, std::string("H0"));
        QCOMPARE(mean.ours, 10.0);
        QCOMPARE(*mean.reference, 11.0);
        QCOMPARE(mean.tolerance, 2.05);
        QVERIFY(std::abs(mean.interval.high - (10.0 + 0.4 * 1.959963984540054)) < 1e-9);
        QVERIFY(mean.isInside());

        const ReproducedCell share = frequencyCell("row", "column", {60, 100}, {0.5, 100.0, 0.01});
        QCOMPARE(share.ours, 0.6);
        QVERIFY(std::abs(share.tolerance - (4.0 * std::sqrt(0.0025 + 0.0024) + 0.005)) < 1e-12);
        QVERIFY(share.interval.contains(0.6) && share.interval.contains(0.52) && !share.interval.contains(0.5));

        const ReproducedCell exact = exactCell("row", "column", 1.0, 1.0 + 1e-6, 1e-9);
        QVERIFY(!exact.isInside() && exact.interval == Interval{});
        QCOMPARE(reducedTrials(5000, {false, 1}), Index(5000));
        QCOMPARE(reducedTrials(5000, {true, 1}), Index(500));
    }

    void deviationsHaveNames()
    {
        QCOMPARE(deviationName(0.5), std::string("σ = 0.5"));
        QCOMPARE(deviationName(2.0), std::string("σ = 2"));
        QCOMPARE(deviationName(INFINITY), std::string("uniform"));
        QCOMPARE(inFormat("%.2f stages", 1.236), std::string("1.24 stages"));
    }

    void partsOfParsons()
    {
        const ReproducedCell cell = printed(judged(cellOf("row", "column", 3.0, {2.0, 5.0}), 3.5, 0.25), 4.0);
        QCOMPARE(cell.ours, 3.0);
        QCOMPARE(cell.interval, (Interval{2.0, 5.0}));
        QCOMPARE(*cell.reference, 3.5);
        QCOMPARE(cell.tolerance, 0.25);
        QCOMPARE(*cell.paper, 4.0);
        // Two runs with a standard error of a half each: √2 · ½ · 4.
        constexpr double error = 0.5;
        const Interval interval{7.0 - 1.959963984540054 * error, 7.0 + 1.959963984540054 * error};
        QVERIFY(std::abs(fourErrors(interval) - std::sqrt(8.0)) < 1e-12);
        QCOMPARE(noiseScene(5, 30).pings, 30);
        QVERIFY(noiseScene(5, 30).targets.empty());
        QVERIFY(noiseScene(~std::uint64_t(0), 1).seed >= 0); // seeds of scenes are not negative
    }
};

FAINTLINE_TEST(tst_Reproduction)
#include "tst_Reproduction.moc"
