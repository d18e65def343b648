#include "model/SequentialModel.h"
#include "support/test.h"

#include "base/Random.h"
#include "support/errors.h"

#include <algorithm>
#include <cmath>

using namespace faintline;
using namespace faintline::test;

namespace {

/// Cells of three axes, slowest first.
struct Shape {
    std::vector<Index> cells;
    std::vector<bool> isFolded;

    Index frame() const { return cells[0] * cells[1] * cells[2]; }
    Index cell(Index a, Index b, Index c) const { return (a * cells[1] + b) * cells[2] + c; }
    Index state(Index a, Index b, Index c) const
    {
        const std::vector<Index> at{a, b, c};
        Index state = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (!isFolded[axis])
                state = state * cells[axis] + at[axis];
        return state;
    }
    Index folded() const
    {
        Index count = 1;
        for (std::size_t axis = 0; axis < 3; ++axis)
            count *= isFolded[axis] ? cells[axis] : 1;
        return count;
    }
};

std::vector<double> randomEvidence(Index count, std::uint64_t seed)
{
    Random random(seed, 1);
    std::vector<double> lambda(std::size_t(count), 0.0);
    for (double &value : lambda)
        value = 8.0 * random.uniform() - 4.0;
    return lambda;
}

} // namespace

/// Axes without state: the reduced cells against loops over the coordinates, and against all trajectories of the
/// unreduced space.
class tst_CellReduction : public QObject
{
    Q_OBJECT

private slots:
    void sumsAndMaximaAreThoseOfTheFoldedCells_data()
    {
        QTest::addColumn<bool>("first");
        QTest::addColumn<bool>("second");
        QTest::addColumn<bool>("third");
        QTest::newRow("last") << false << false << true;
        QTest::newRow("middle") << false << true << false;
        QTest::newRow("first") << true << false << false;
        QTest::newRow("two") << true << false << true;
        QTest::newRow("all") << true << true << true;
    }

    void sumsAndMaximaAreThoseOfTheFoldedCells()
    {
        QFETCH(bool, first);
        QFETCH(bool, second);
        QFETCH(bool, third);
        const Shape shape{{3, 4, 5}, {first, second, third}};
        const CellReduction reduction(shape.cells, shape.isFolded);
        QCOMPARE(reduction.frameCells(), Index(60));
        QCOMPARE(reduction.foldedCells(), shape.folded());
        QCOMPARE(reduction.stateCells() * reduction.foldedCells(), Index(60));

        const std::vector<double> lambda = randomEvidence(shape.frame(), 3);
        const auto states = std::size_t(reduction.stateCells());
        std::vector<double> sums(states, 0.0), largest(states, -1e300);
        for (Index a = 0; a < 3; ++a)
            for (Index b = 0; b < 4; ++b)
                for (Index c = 0; c < 5; ++c) {
                    const double value = lambda[std::size_t(shape.cell(a, b, c))];
                    const auto state = std::size_t(shape.state(a, b, c));
                    sums[state] += std::exp(value) / double(shape.folded());
                    largest[state] = std::max(largest[state], value);
                }
        std::vector<double> sum(states), maximum(states);
        reduction.sum(lambda, sum);
        reduction.maximum(lambda, maximum);
        for (std::size_t state = 0; state < states; ++state) {
            QVERIFY2(std::abs(sum[state] - std::log(sums[state])) < 1e-12, qPrintable(QString::number(state)));
            QCOMPARE(maximum[state], largest[state] - std::log(double(shape.folded())));
        }
    }

    void largeEvidenceDoesNotOverflow()
    {
        const CellReduction reduction({2, 3}, {false, true});
        const std::vector<double> lambda{900.0, 900.0, 900.0, -900.0, -901.0, -902.0}; // e^900 is no double
        std::vector<double> sum(2);
        reduction.sum(lambda, sum);
        QVERIFY(std::abs(sum[0] - 900.0) < 1e-12); // the mean of three equal values
        const double second = -900.0 + std::log((1.0 + std::exp(-1.0) + std::exp(-2.0)) / 3.0);
        QVERIFY(std::abs(sum[1] - second) < 1e-12);
    }

    void withoutFoldedAxesNothingChanges()
    {
        const CellReduction reduction({4, 3}, {false, false});
        const std::vector<double> lambda = randomEvidence(12, 4);
        std::vector<double> sum(12), maximum(12);
        reduction.sum(lambda, sum);
        reduction.maximum(lambda, maximum);
        QCOMPARE(sum, lambda);
        QCOMPARE(maximum, lambda);
        QVERIFY(!reduction.isFolded(0) && !reduction.isFolded(1));
    }

    void theBestCellIsTheFirstOfTheLargest()
    {
        const CellReduction reduction({2, 2, 4}, {false, true, true});
        std::vector<double> lambda(16, -1.0);
        lambda[1 * 8 + 1 * 4 + 2] = 5.0; // cell (1, 1, 2) of state 1
        lambda[0 * 8 + 0 * 4 + 3] = 2.0; // a tie in state 0: (0, 0, 3) …
        lambda[0 * 8 + 1 * 4 + 0] = 2.0; // … and (0, 1, 0)
        QCOMPARE(reduction.best(lambda, 1), (std::vector<Index>{1, 1, 2}));
        QCOMPARE(reduction.best(lambda, 0), (std::vector<Index>{0, 0, 3}));
    }

    /// The sum over all sequences of (state, folded cell) is the sum over the sequences of states of the reduced evidence,
    /// for any law of the states' moves; so is the maximum.
    void trajectoriesFactorise()
    {
        constexpr Index states = 3, folded = 4;
        constexpr double stay = 0.6, move = 0.2; // of three states in a ring
        const CellReduction reduction({states, folded}, {false, true});
        const std::vector<std::vector<double>> frames{randomEvidence(12, 5), randomEvidence(12, 6),
                                                      randomEvidence(12, 7)};
        const auto lnMove = [&](Index from, Index to) { return std::log(from == to ? stay : move); };

        double total = 0.0, best = -1e300;
        for (Index path = 0; path < 12 * 12 * 12; ++path) {
            const std::vector<Index> cells{path % 12, path / 12 % 12, path / 144};
            double score = 0.0;
            for (std::size_t i = 0; i < 3; ++i) {
                score += frames[i][std::size_t(cells[i])] - std::log(double(folded)); // P(d) of each stage
                if (i > 0)
                    score += lnMove(cells[i - 1] / folded, cells[i] / folded);
            }
            total += std::exp(score);
            best = std::max(best, score);
        }

        std::vector<std::vector<double>> sums, maxima;
        for (const std::vector<double> &frame : frames) {
            sums.emplace_back(std::size_t(states));
            maxima.emplace_back(std::size_t(states));
            reduction.sum(frame, sums.back());
            reduction.maximum(frame, maxima.back());
        }
        double reducedTotal = 0.0, reducedBest = -1e300;
        for (Index a = 0; a < states; ++a)
            for (Index b = 0; b < states; ++b)
                for (Index c = 0; c < states; ++c) {
                    const auto at = [&](const auto &of) {
                        return of[0][std::size_t(a)] + of[1][std::size_t(b)] + of[2][std::size_t(c)] + lnMove(a, b)
                               + lnMove(b, c);
                    };
                    reducedTotal += std::exp(at(sums));
                    reducedBest = std::max(reducedBest, at(maxima));
                }
        QVERIFY(std::abs(std::log(reducedTotal) - std::log(total)) < 1e-12);
        QVERIFY(std::abs(reducedBest - best) < 1e-12);
    }

    void tooManyCellsAreRefused()
    {
        QVERIFY(contains(errorOf([] { CellReduction({65536, 65536}, {false, true}); }), "model.axes"));
    }
};

FAINTLINE_TEST(tst_CellReduction)
#include "tst_CellReduction.moc"
