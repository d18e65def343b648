#include "base/Random.h"
#include "support/test.h"
#include "track/closeTrackers.h"

using namespace faintline;

/// Which cells belong to a neighbour, on an axis that can be checked by eye; who is near, against looking at all.
class tst_closeTrackers : public QObject
{
    Q_OBJECT

private slots:
    void cellsNearerToTheOther_data()
    {
        QTest::addColumn<bool>("cyclic");
        QTest::addColumn<int>("own");
        QTest::addColumn<int>("other");
        QTest::addColumn<int>("farthest");
        QTest::addColumn<QList<int>>("cells"); // of the other's box, ±3 cells
        QTest::newRow("above") << false << 5 << 9 << 10 << QList<int>{8, 9, 10, 11, 12}; // 7 is as near to either
        QTest::newRow("below") << false << 9 << 5 << 10 << QList<int>{2, 3, 4, 5, 6};
        QTest::newRow("round the end") << true << 1 << 18 << 10 << QList<int>{15, 16, 17, 18, 19};
        QTest::newRow("no way round the end") << false << 1 << 18 << 10 << QList<int>{};
        QTest::newRow("too far") << false << 5 << 9 << 3 << QList<int>{};
        QTest::newRow("at the same place") << false << 5 << 5 << 10 << QList<int>{};
    }

    void cellsNearerToTheOther()
    {
        QFETCH(bool, cyclic);
        QFETCH(int, own);
        QFETCH(int, other);
        QFETCH(int, farthest);
        QFETCH(QList<int>, cells);
        const Grid grid{{{"bearing", "°", 0.0, 1.0, 20, cyclic}}};
        const PlaceIndex places(grid, {{own}, {other}});
        std::vector<Index> found = cellsOfNeighbours(grid, places, 0, farthest, {3});
        std::sort(found.begin(), found.end());
        QCOMPARE(found, std::vector<Index>(cells.begin(), cells.end()));
    }

    void asByLookingAtAll_data()
    {
        QTest::addColumn<bool>("cyclic");
        QTest::addColumn<int>("reach");
        for (const bool cyclic : {false, true})
            for (const int reach : {0, 1, 4, 9, 10, 30})
                QTest::addRow("%s, %d", cyclic ? "cyclic" : "bounded", reach) << cyclic << reach;
    }

    void asByLookingAtAll()
    {
        QFETCH(bool, cyclic);
        QFETCH(int, reach);
        constexpr Index count = 20;
        const Grid grid{{{"bearing", "°", 0.0, 1.0, count, cyclic}, {"range", "m", 0.0, 1.0, 5, false}}};
        Random random(3, 1);
        std::vector<std::vector<Index>> places;
        for (int i = 0; i < 30; ++i)
            places.push_back({Index(random.uniform() * count), Index(random.uniform() * 5.0)});
        const PlaceIndex index(grid, places);
        for (std::size_t own = 0; own < places.size(); ++own) {
            std::vector<std::size_t> expected;
            for (std::size_t i = 0; i < places.size(); ++i) {
                Index distance = std::abs(places[i][0] - places[own][0]);
                if (cyclic)
                    distance = std::min(distance, count - distance);
                if (distance <= reach)
                    expected.push_back(i);
            }
            std::vector<std::size_t> found;
            index.forEachNear(index[own], reach, [&](std::size_t i) { found.push_back(i); });
            std::sort(found.begin(), found.end());
            QCOMPARE(found, expected);
        }
    }
};

FAINTLINE_TEST(tst_closeTrackers)
#include "tst_closeTrackers.moc"
