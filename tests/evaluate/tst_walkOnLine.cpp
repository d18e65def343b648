#include "evaluate/theory/walkOnLine.h"
#include "support/test.h"

#include <cmath>
#include <numbers>
#include <numeric>

using namespace faintline;

namespace {

/// Mass of a normal law of the given deviation between d - ½ and d + ½.
double stepWeight(Index d, double deviation)
{
    const auto below = [&](double x) { return 0.5 * std::erfc(-x / (deviation * std::numbers::sqrt2)); };
    return below(double(d) + 0.5) - below(double(d) - 0.5);
}

/// P(to | from), row by row: the steps that stay on the line share what those that leave it would have.
std::vector<std::vector<double>> walkMatrix(Index cells, double deviation)
{
    std::vector<std::vector<double>> rows;
    for (Index from = 0; from < cells; ++from) {
        std::vector<double> row;
        for (Index to = 0; to < cells; ++to)
            row.push_back(stepWeight(std::abs(to - from), deviation));
        const double sum = std::accumulate(row.begin(), row.end(), 0.0);
        for (double &p : row)
            p /= sum;
        rows.push_back(std::move(row));
    }
    return rows;
}

/// Entropy of a step in the law that the walk comes to after very many.
double entropyRate(const std::vector<std::vector<double>> &rows)
{
    std::vector<double> law(rows.size(), 1.0 / double(rows.size()));
    for (int step = 0; step < 20000; ++step) {
        std::vector<double> next(rows.size(), 0.0);
        for (std::size_t from = 0; from < rows.size(); ++from)
            for (std::size_t to = 0; to < rows.size(); ++to)
                next[to] += law[from] * rows[from][to];
        law = std::move(next);
    }
    double rate = 0.0;
    for (std::size_t from = 0; from < rows.size(); ++from)
        for (const double p : rows[from])
            rate -= p > 0.0 ? law[from] * p * std::log(p) : 0.0;
    return rate;
}

} // namespace

/// The walk of the general problem: its matrix and its entropy, each written out.
class tst_walkOnLine : public QObject
{
    Q_OBJECT

private slots:
    void movesAreTheMatrix()
    {
        constexpr Index cells = 9;
        const SequentialModel model = walkOnLine(cells, 1.3, 2.0);
        const StateSpace &space = model.markov.space;
        QCOMPARE(space.stateCount(), cells);
        QCOMPARE(model.markov.likelihood.snr(), 2.0);
        QVERIFY(model.markov.likelihood.kind() == LikelihoodKind::Exponential);
        const auto rows = walkMatrix(cells, 1.3);
        const KinematicAxis &axis = space.axes().front();
        for (Index to = 0; to < cells; ++to) {
            std::vector<double> found(std::size_t(cells), 0.0);
            for (const StateSpace::Predecessor &before : space.predecessors(to))
                found[std::size_t(before.state)] += std::exp(before.lnProbability);
            for (Index from = 0; from < cells; ++from)
                QVERIFY(std::abs(found[std::size_t(from)] - rows[std::size_t(from)][std::size_t(to)]) < 1e-12);
        }
        QVERIFY(axis.largestLoss() < 1e-12);
    }

    void theFirstStepIsTakenFromTheMiddle()
    {
        for (const Index cells : {Index(9), Index(10)}) {
            const std::vector<double> law = walkOnLine(cells, 1.3, 2.0).initialLaw();
            const auto rows = walkMatrix(cells, 1.3);
            QCOMPARE(std::ssize(law), cells);
            for (Index cell = 0; cell < cells; ++cell)
                QVERIFY(std::abs(law[std::size_t(cell)] - rows[std::size_t(cells / 2)][std::size_t(cell)]) < 1e-12);
        }
    }

    void withoutADeviationThePathIsKnown()
    {
        const SequentialModel model = walkOnLine(7, 0.0, 1.0);
        std::vector<double> middle(7, 0.0);
        middle[3] = 1.0;
        QCOMPARE(model.initialLaw(), middle);
        for (Index state = 0; state < 7; ++state) {
            const auto before = model.markov.space.predecessors(state);
            QCOMPARE(before.size(), std::size_t(1));
            QCOMPARE(before.front().state, state);
            QCOMPARE(before.front().lnProbability, 0.0);
        }
    }

    void anInfiniteDeviationNeedsNoState()
    {
        const SequentialModel model = walkOnLine(7, INFINITY, 1.0);
        QCOMPARE(model.markov.space.stateCount(), Index(1));
        QCOMPARE(model.reduction.frameCells(), Index(7));
        QCOMPARE(model.reduction.foldedCells(), Index(7));
    }

    void entropyOfTheStationaryLaw_data()
    {
        QTest::addColumn<int>("cells");
        QTest::addColumn<double>("deviation");
        QTest::newRow("two cells") << 2 << 0.6;
        QTest::newRow("narrow steps") << 12 << 0.4;
        QTest::newRow("wide steps") << 12 << 3.0;
        QTest::newRow("as wide as the line") << 5 << 5.0;
    }

    void entropyOfTheStationaryLaw()
    {
        QFETCH(int, cells);
        QFETCH(double, deviation);
        const double expected = entropyRate(walkMatrix(cells, deviation)) / std::log(double(cells));
        const double found = relativeEntropyRate(cells, deviation);
        QVERIFY2(std::abs(found - expected) < 1e-9, qPrintable(QString("%1, not %2").arg(found).arg(expected)));
    }

    void entropyRisesWithTheDeviation()
    {
        double before = relativeEntropyRate(50, 0.0);
        QCOMPARE(before, 0.0);
        for (const double deviation : {0.3, 0.5, 1.0, 2.0, 5.0, 100.0, double(INFINITY)}) {
            const double rate = relativeEntropyRate(50, deviation);
            QVERIFY(rate > before && rate <= 1.0);
            before = rate;
        }
        QCOMPARE(before, 1.0);
    }

    void oneCellKnowsItsPath()
    {
        for (const double deviation : {0.0, 1.0, double(INFINITY)}) {
            QCOMPARE(relativeEntropyRate(1, deviation), 0.0);
            QCOMPARE(walkOnLine(1, deviation, 1.0).markov.space.stateCount(), Index(1));
            QVERIFY(std::abs(walkOnLine(1, deviation, 1.0).initialLaw().front() - 1.0) < 1e-12);
        }
    }
};

FAINTLINE_TEST(tst_walkOnLine)
#include "tst_walkOnLine.moc"
