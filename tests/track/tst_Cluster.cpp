#include "support/test.h"
#include "track/Cluster.h"

#include "base/Random.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace faintline;

namespace {

Grid gridOf(std::vector<Index> counts, bool isLastCyclic)
{
    Grid grid;
    for (const Index count : counts)
        grid.axes.push_back({"axis", "", 0.0, 1.0, count, false});
    grid.axes.back().cyclic = isLastCyclic;
    return grid;
}

bool areLinked(const Grid &grid, Index a, Index b, const std::vector<Index> &link)
{
    for (std::size_t axis = grid.axes.size(); axis-- > 0;) {
        const Index count = grid.axes[axis].count;
        Index d = std::abs(a % count - b % count);
        if (grid.axes[axis].cyclic)
            d = std::min(d, count - d);
        if (d > link[axis])
            return false;
        a /= count;
        b /= count;
    }
    return true;
}

/// By giving all pairs of linked cells the lower one's number, until nothing changes.
std::vector<Cluster> byPairs(const Grid &grid, const std::vector<float> &d, double threshold, double shoulder,
                             const std::vector<Index> &link)
{
    std::vector<Index> numbers;
    for (Index cell = 0; cell < std::ssize(d); ++cell)
        numbers.push_back(double(d[std::size_t(cell)]) > shoulder ? cell : -1);
    for (bool hasChanged = true; hasChanged;) {
        hasChanged = false;
        for (std::size_t a = 0; a < numbers.size(); ++a)
            for (std::size_t b = 0; b < numbers.size(); ++b)
                if (numbers[a] >= 0 && numbers[b] > numbers[a] && areLinked(grid, Index(a), Index(b), link)) {
                    numbers[b] = numbers[a];
                    hasChanged = true;
                }
    }
    std::vector<Cluster> clusters;
    for (Index number = 0; number < std::ssize(d); ++number) {
        Cluster cluster;
        cluster.peakStatistic = -std::numeric_limits<float>::infinity();
        for (Index cell = 0; cell < std::ssize(d); ++cell)
            if (numbers[std::size_t(cell)] == number) {
                cluster.cells.push_back(cell);
                if (d[std::size_t(cell)] > cluster.peakStatistic) {
                    cluster.peakStatistic = d[std::size_t(cell)];
                    cluster.peakCell = cell;
                }
            }
        if (!cluster.cells.empty() && double(cluster.peakStatistic) > threshold)
            clusters.push_back(std::move(cluster));
    }
    std::sort(clusters.begin(), clusters.end(),
              [](const Cluster &a, const Cluster &b) { return a.peakCell < b.peakCell; });
    return clusters;
}

} // namespace

/// Crossings that belong together, against linking all pairs of cells.
class tst_Cluster : public QObject
{
    Q_OBJECT

private slots:
    void arePairsThatAreLinked_data();
    void arePairsThatAreLinked();
    void equalsDoNotExceed();
    void theLowestOfEqualPeaks();
    void whatIsNoNumberIsNoCrossing();
    void nothingCrosses();
};

void tst_Cluster::arePairsThatAreLinked_data()
{
    QTest::addColumn<std::vector<Index>>("counts");
    QTest::addColumn<bool>("isCyclic");
    QTest::addColumn<std::vector<Index>>("link");
    using Cells = std::vector<Index>;
    QTest::newRow("a line") << Cells{120} << false << Cells{2};
    QTest::newRow("neighbours alone") << Cells{120} << false << Cells{1};
    QTest::newRow("nothing is linked") << Cells{120} << false << Cells{0};
    QTest::newRow("a ring") << Cells{60} << true << Cells{3};
    QTest::newRow("a ring that is linked all round") << Cells{7} << true << Cells{5};
    QTest::newRow("range and bearing") << Cells{15, 10} << true << Cells{2, 1};
    QTest::newRow("three axes") << Cells{5, 6, 5} << false << Cells{1, 2, 0};
}

void tst_Cluster::arePairsThatAreLinked()
{
    QFETCH(std::vector<Index>, counts);
    QFETCH(bool, isCyclic);
    QFETCH(std::vector<Index>, link);
    const Grid grid = gridOf(counts, isCyclic);
    Random random(121, 0);
    std::size_t clusters = 0;
    for (int round = 0; round < 30; ++round) {
        std::vector<float> d;
        for (Index cell = 0; cell < grid.size(); ++cell)
            d.push_back(float(std::floor(8.0 * random.exponential()) / 4.0)); // with ties
        const auto found = findClusters(grid, d, 4.0, 2.5, link);
        const auto expected = byPairs(grid, d, 4.0, 2.5, link);
        QCOMPARE(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            QCOMPARE(found[i].peakCell, expected[i].peakCell);
            QCOMPARE(found[i].peakStatistic, expected[i].peakStatistic);
            QCOMPARE(found[i].cells, expected[i].cells);
        }
        clusters += found.size();
    }
    QVERIFY(clusters > 0);
}

void tst_Cluster::equalsDoNotExceed()
{
    const Grid grid = gridOf({6}, false);
    const std::vector<float> d{0.0f, 2.5f, 4.0f, 2.75f, 4.25f, 2.5f};
    const auto found = findClusters(grid, d, 4.0, 2.5, {1});
    QCOMPARE(found.size(), std::size_t(1));
    QCOMPARE(found[0].cells, (std::vector<Index>{2, 3, 4}));
    QVERIFY(findClusters(grid, d, 4.25, 2.5, {1}).empty());
}

void tst_Cluster::theLowestOfEqualPeaks()
{
    const Grid grid = gridOf({3, 3}, false);
    const std::vector<float> d{0.0f, 5.0f, 0.0f, 5.0f, 5.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    const auto found = findClusters(grid, d, 4.0, 4.0, {1, 1});
    QCOMPARE(found.size(), std::size_t(1));
    QCOMPARE(found[0].peakCell, Index(1));
    QCOMPARE(found[0].cells, (std::vector<Index>{1, 3, 4}));
}

void tst_Cluster::whatIsNoNumberIsNoCrossing()
{
    const float no = std::numeric_limits<float>::quiet_NaN();
    const float high = std::numeric_limits<float>::infinity();
    const auto found = findClusters(gridOf({5}, false), std::vector<float>{no, 9.0f, no, -high, high}, 4.0, 4.0, {1});
    QCOMPARE(found.size(), std::size_t(2));
    QCOMPARE(found[0].cells, (std::vector<Index>{1}));
    QCOMPARE(found[1].cells, (std::vector<Index>{4}));
}

void tst_Cluster::nothingCrosses()
{
    const Grid grid = gridOf({4, 4}, true);
    QVERIFY(findClusters(grid, std::vector<float>(16, 3.0f), 4.0, 2.0, {1, 1}).empty());
    QVERIFY(findClusters(gridOf({0}, false), {}, 4.0, 2.0, {1}).empty());
    const auto all = findClusters(grid, std::vector<float>(16, 5.0f), 4.0, 2.0, {1, 1});
    QCOMPARE(all.size(), std::size_t(1));
    QCOMPARE(all[0].cells.size(), std::size_t(16));
    QCOMPARE(all[0].peakCell, Index(0));
}

FAINTLINE_TEST(tst_Cluster)
#include "tst_Cluster.moc"
