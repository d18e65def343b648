#include "support/test.h"
#include "track/closeTrackers.h"

using namespace faintline;

/// Which cells belong to a neighbour, on an axis that can be checked by eye.
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
};

FAINTLINE_TEST(tst_closeTrackers)
#include "tst_closeTrackers.moc"
