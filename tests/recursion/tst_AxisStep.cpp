#include "recursion/AxisStep.h"
#include "support/test.h"

#include "base/Random.h"

#include <cmath>
#include <limits>
#include <set>

using namespace faintline;

namespace {

constexpr double nothingHere = -std::numeric_limits<double>::infinity();

KinematicAxis stepAxis(Index cells, int firstRate, int rateCount, std::vector<double> change, int ratesPerCell = 1)
{
    return {.cells = cells,
            .firstRate = firstRate,
            .rateCount = rateCount,
            .rateChange = std::move(change),
            .ratesPerCell = ratesPerCell};
}

std::vector<double> someScores(Index count)
{
    Random random(51, 0);
    std::vector<double> scores;
    for (Index i = 0; i < count; ++i)
        scores.push_back(random.uniform());
    return scores;
}

using Source = std::pair<Index, Index>; ///< a rate, and by how many cells it is moved

/// The rates that a source stands for: itself, or all that a shared maximum is made of.
std::set<Source> ratesOf(const SharedMaxima &maxima, Index rates, Index from, Index cells)
{
    if (from < rates)
        return {{from, cells}};
    for (const std::vector<SharedMaximum> &listed : maxima.before)
        for (const SharedMaximum &maximum : listed)
            if (maximum.number == from) {
                std::set<Source> all = ratesOf(maxima, rates, maximum.of, cells);
                all.merge(ratesOf(maxima, rates, maximum.other, cells + maximum.back));
                return all;
            }
    return {};
}

} // namespace

/// What the recursion's inner loops go through: shifted planes, tiles with margins, and shared maxima, each against
/// plain loops.
class tst_AxisStep : public QObject
{
    Q_OBJECT

private slots:
    void planesAreShifted_data()
    {
        QTest::addColumn<int>("inner");
        QTest::addColumn<bool>("isCyclic");
        for (const int inner : {1, 3})
            for (const bool isCyclic : {false, true})
                QTest::addRow("%d inner cells, %s", inner, isCyclic ? "cyclic" : "bounded") << inner << isCyclic;
    }

    void planesAreShifted()
    {
        QFETCH(int, inner);
        QFETCH(bool, isCyclic);
        constexpr Index cells = 5;
        constexpr Index outer = 4;
        const AxisStep<double> step{cells, inner, isCyclic};
        const std::vector<double> from = someScores(outer * cells * inner);
        for (Index by = isCyclic ? -4 : -7; by <= (isCyclic ? 4 : 7); ++by) {
            std::vector<double> to(from.size(), 99.0);
            shiftCells<MaxPlus<double>>(step, by, from, to.data());
            for (Index block = 0; block < outer; ++block)
                for (Index cell = 0; cell < cells; ++cell)
                    for (Index i = 0; i < inner; ++i) {
                        Index source = cell - by;
                        if (isCyclic)
                            source = (source + cells) % cells;
                        const bool isThere = source >= 0 && source < cells;
                        const double expected =
                            isThere ? from[std::size_t((block * cells + source) * inner + i)] : nothingHere;
                        QCOMPARE(to[std::size_t((block * cells + cell) * inner + i)], expected);
                    }
        }
    }

    void stepsOfAnAxisThatStaysAreNone()
    {
        const auto steps =
            stepsOfPhase<MaxPlus<float>>(StateSpace({stepAxis(7, 0, 1, {1.0}), stepAxis(3, 0, 1, {1.0})}), 0, 1.0);
        QVERIFY(steps.first.shifts.empty());
        QVERIFY(steps.later.empty());
        QCOMPARE(steps.reach(), Index(0));
        const auto moving = stepsOfPhase<MaxPlus<float>>(StateSpace({stepAxis(7, -3, 4, {1.0})}), 0, 1.0);
        QCOMPARE(moving.first.shifts.size(), std::size_t(4));
        QCOMPARE(moving.reach(), Index(3));
    }

    // Every plane moved by other than nothing is copied once, whoever wants it.
    void movesOfLaterAxesAreCopies()
    {
        const StateSpace space({stepAxis(6, 0, 1, {1.0}), stepAxis(5, -1, 3, {0.5, 0.25})});
        const auto steps = stepsOfPhase<SumProduct>(space, 0, 1.0);
        QCOMPARE(steps.later.size(), std::size_t(1));
        const AxisStep<double> &later = steps.later.front();
        std::set<Source> copied;
        for (const Shift<double> &copy : later.copies) {
            QVERIFY(copy.cells != 0);
            QVERIFY(copied.insert({copy.from, copy.cells}).second);
        }
        QCOMPARE(later.shifts.size(), std::size_t(3));
        for (Index to = 0; to < 3; ++to) {
            double sum = 0.0;
            for (const Shift<double> &shift : later.shifts[std::size_t(to)]) {
                QCOMPARE(shift.cells, Index(0));
                const Index from = shift.from < 3 ? shift.from : later.copies[std::size_t(shift.from - 3)].from;
                QCOMPARE(shift.weight, from == to ? 0.5 : std::abs(from - to) == 1 ? 0.25 : 0.0);
                sum += shift.weight;
            }
            QCOMPARE(sum, to == 1 ? 1.0 : 0.75);
        }
    }

    void tilesSeeBeyondTheirRows_data()
    {
        QTest::addColumn<bool>("isCyclic");
        QTest::addColumn<int>("rows");
        QTest::addColumn<int>("tileRows");
        for (const bool isCyclic : {false, true})
            for (const auto &[rows, tileRows] : {std::pair{20, 4}, {20, 7}, {5, 5}, {6, 4}, {3, 1}})
                QTest::addRow("%d rows by %d, %s", rows, tileRows, isCyclic ? "cyclic" : "bounded")
                    << isCyclic << rows << tileRows;
    }

    void tilesSeeBeyondTheirRows()
    {
        QFETCH(bool, isCyclic);
        QFETCH(int, rows);
        QFETCH(int, tileRows);
        constexpr Index planes = 3;
        constexpr Index inner = 2;
        constexpr Index reach = 2;
        TiledPlanes<MaxPlus<double>> tiled({planes, rows, inner, isCyclic}, reach, tileRows);
        const std::vector<double> scores = someScores(planes * rows * inner);
        tiled.fillMargins(scores);
        for (const TileRows &tile : tiled.tiles())
            for (Index plane = 0; plane < planes; ++plane) {
                const double *const first = tiled.rowsOf(scores, plane, tile.first);
                for (Index row = -reach; row < tile.count + reach; ++row)
                    for (Index i = 0; i < inner; ++i) {
                        Index source = tile.first + row;
                        if (isCyclic)
                            source = (source + rows) % rows;
                        const bool isThere = source >= 0 && source < rows;
                        QCOMPARE(first[row * inner + i],
                                 isThere ? scores[std::size_t((plane * rows + source) * inner + i)] : nothingHere);
                    }
            }
    }

    void tilesCoverAllRowsOnce()
    {
        for (const Index rows : {1, 2, 9, 10, 11})
            for (const Index tileRows : {1, 3, 10, 100}) {
                const TiledPlanes<MaxPlus<double>> tiled({1, rows, 1, false}, 1, tileRows);
                Index next = 0;
                for (const TileRows &tile : tiled.tiles()) {
                    QCOMPARE(tile.first, next);
                    QVERIFY(tile.count >= 1);
                    next += tile.count;
                }
                QCOMPARE(next, rows);
            }
    }

    void sharedMaximaAreOfTheSameRates_data()
    {
        QTest::addColumn<int>("rates");
        QTest::addColumn<int>("changes"); ///< rates to either side that are equally likely
        QTest::addColumn<int>("ratesPerCell");
        QTest::newRow("nine rates, all from all") << 9 << 8 << 1;
        QTest::newRow("nine rates, four to either side") << 9 << 4 << 1;
        QTest::newRow("twenty rates, seven to either side") << 20 << 7 << 1;
        QTest::newRow("eleven rates, three to either side") << 11 << 3 << 1;
        QTest::newRow("halves of a cell") << 13 << 6 << 2;
    }

    void sharedMaximaAreOfTheSameRates()
    {
        QFETCH(int, rates);
        QFETCH(int, changes);
        QFETCH(int, ratesPerCell);
        const std::vector<double> law(std::size_t(changes + 1), 1.0 / (2 * changes + 1));
        const StateSpace space({stepAxis(200, -rates / 2, rates, law, ratesPerCell)});
        AxisStep<float> step = stepsOfPhase<MaxPlus<float>>(space, 0, 1.0).first;
        const AxisStep<float> plain = step;
        const SharedMaxima maxima = shareMaxima(step, false);
        QCOMPARE(step.shifts.size(), plain.shifts.size());
        std::set<Index> made;
        for (std::size_t to = 0; to < plain.shifts.size(); ++to) {
            for (const SharedMaximum &maximum : maxima.before[to]) { // what one is made of comes before it
                QVERIFY(maximum.of < rates || made.contains(maximum.of));
                QVERIFY(maximum.other < rates || made.contains(maximum.other));
                made.insert(maximum.number);
            }
            std::set<Source> expected;
            for (const Shift<float> &shift : plain.shifts[to])
                expected.insert({shift.from, shift.cells});
            std::set<Source> found;
            for (const Shift<float> &shift : step.shifts[to]) {
                QVERIFY(shift.from < rates || made.contains(shift.from));
                QCOMPARE(shift.weight, plain.shifts[to].front().weight);
                found.merge(ratesOf(maxima, rates, shift.from, shift.cells));
            }
            QVERIFY(found == expected);
        }
        if (ratesPerCell == 1 && changes >= 4) { // and it is worth it
            std::size_t before = 0;
            std::size_t after = 0;
            for (std::size_t to = 0; to < plain.shifts.size(); ++to) {
                before += plain.shifts[to].size();
                after += step.shifts[to].size() + maxima.before[to].size();
            }
            QVERIFY2(after < before, qPrintable(QString("%1 instead of %2").arg(after).arg(before)));
        }
    }

    void unequalWeightsAreNotShared()
    {
        const StateSpace space({stepAxis(200, -4, 9, {0.2, 0.16, 0.12, 0.08, 0.04})});
        AxisStep<float> step = stepsOfPhase<MaxPlus<float>>(space, 0, 1.0).first;
        const AxisStep<float> plain = step;
        const SharedMaxima maxima = shareMaxima(step, false);
        QCOMPARE(maxima.ring, Index(0));
        QCOMPARE(maxima.longestSpan(), Index(0));
        for (std::size_t to = 0; to < plain.shifts.size(); ++to)
            for (std::size_t i = 0; i < plain.shifts[to].size(); ++i) {
                QCOMPARE(step.shifts[to][i].from, plain.shifts[to][i].from);
                QCOMPARE(step.shifts[to][i].cells, plain.shifts[to][i].cells);
            }
    }
};

FAINTLINE_TEST(tst_AxisStep)
#include "tst_AxisStep.moc"
