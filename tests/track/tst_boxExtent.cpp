#include "support/test.h"
#include "track/Cluster.h"

using namespace faintline;

/// How far boxes around tracks reach, on frames that can be checked by eye.
class tst_boxExtent : public QObject
{
    Q_OBJECT

private slots:
    void overTheHill_data()
    {
        QTest::addColumn<QList<float>>("right"); // of cell 10
        QTest::addColumn<int>("step");
        QTest::addColumn<int>("centre");
        QTest::addColumn<int>("halfWidth");
        // On the left the first step is below 8: the box keeps cell 9 there.
        QTest::newRow("two steps") << QList<float>{50, 40, 30, 20, 12, 3, 2} << 2 << 12 << 3;      // cells 9 … 15
        QTest::newRow("it rises again") << QList<float>{50, 40, 30, 45, 12, 3, 2} << 2 << 11 << 2; // cells 9 … 13
        QTest::newRow("none") << QList<float>{50, 7, 7, 7, 7, 7, 7} << 2 << 10 << 1;
        QTest::newRow("not followed") << QList<float>{50, 40, 30, 20, 12, 3, 2} << 0 << 10 << 1;
    }

    void overTheHill()
    {
        QFETCH(QList<float>, right);
        QFETCH(int, step);
        QFETCH(int, centre);
        QFETCH(int, halfWidth);
        const Grid grid{{{"frequency", "Hz", 0.0, 1.0, 20, false}}};
        std::vector<float> y(20, 1.0f);
        y[10] = 100.0f;
        std::copy(right.begin(), right.end(), y.begin() + 11);
        const CellBox box = overSkirts({{10}, {1}}, grid, y, step);
        QCOMPARE(box.centre, std::vector<Index>{centre});
        QCOMPARE(box.halfWidth, std::vector<Index>{halfWidth});
    }

    void aFaintLineHasNoSkirts()
    {
        const Grid grid{{{"frequency", "Hz", 0.0, 1.0, 20, false}}};
        const std::vector<float> y(20, 7.9f);
        QCOMPARE(overSkirts({{10}, {1}}, grid, y, 2).halfWidth, std::vector<Index>{1});
    }

    void overACluster()
    {
        const Grid grid{{{"range", "m", 0.0, 1.0, 10, false}, {"bearing", "°", 0.0, 1.0, 36, true}}};
        const std::vector<Index> cells{grid.cell({4, 35}), grid.cell({6, 1})}; // across north
        const CellBox box = overCells({{5, 0}, {0, 0}}, grid, cells, {1, 2});
        QCOMPARE(box.centre, (std::vector<Index>{5, 0}));
        QCOMPARE(box.halfWidth, (std::vector<Index>{2, 3}));
    }
};

FAINTLINE_TEST(tst_boxExtent)
#include "tst_boxExtent.moc"
