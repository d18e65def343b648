#include "base/Random.h"
#include "noise/medians.h"
#include "support/test.h"

#include <algorithm>

using namespace faintline;

/// Medians of many columns at once against std::nth_element; means over a window against their definition.
class tst_medians : public QObject
{
    Q_OBJECT

private slots:
    void columns_data()
    {
        QTest::addColumn<int>("rows");
        QTest::addColumn<int>("cells");
        for (int rows : {1, 2, 3, 48, 63, 64, 512})
            for (int cells : {1, 31, 32, 33, 100})
                QTest::addRow("%d rows, %d cells", rows, cells) << rows << cells;
    }

    void columns()
    {
        QFETCH(int, rows);
        QFETCH(int, cells);
        const auto r = std::size_t(rows);
        const auto c = std::size_t(cells);
        std::vector<float> frames(r * c);
        Random(9, std::uint64_t(rows)).exponentials(frames);
        std::vector<float> found(c);
        columnMedians(frames, found);
        for (std::size_t cell = 0; cell < c; ++cell) {
            std::vector<float> column(r);
            for (std::size_t row = 0; row < r; ++row)
                column[row] = frames[row * c + cell];
            std::nth_element(column.begin(), column.begin() + (rows - 1) / 2, column.end());
            QCOMPARE(found[cell], column[(r - 1) / 2]); // the lower of two
        }
    }

    void equalValues()
    {
        const std::vector<float> frames{0.0f, 3.0f, 0.0f, 3.0f, 1.0f, 3.0f, 2.0f, 3.0f};
        std::vector<float> found(2);
        columnMedians(frames, found);
        QCOMPARE(found, (std::vector<float>{0.0f, 3.0f})); // of 0 0 1 2, and of 3 3 3 3
    }

    void largestAndSmallestFloats()
    {
        constexpr float largest = std::numeric_limits<float>::max();
        constexpr float smallest = std::numeric_limits<float>::denorm_min();
        const std::vector<float> frames{largest, smallest, largest, smallest, 1.0f, 0.0f};
        std::vector<float> found(2);
        columnMedians(frames, found);
        QCOMPARE(found, (std::vector<float>{largest, smallest}));
    }

    void meanOverAWindow()
    {
        const std::vector<double> values{1.0, 2.0, 6.0, 100.0, 4.0};
        const std::vector<double> weights{1.0, 1.0, 1.0, 0.0, 1.0};
        std::vector<double> found(5);
        runningMean(values, weights, 1, found);
        QCOMPARE(found, (std::vector<double>{1.5, 3.0, 4.0, 5.0, 4.0}));
    }

    void meanWithoutWeights()
    {
        std::vector<double> found(2);
        runningMean(std::vector<double>{5.0, 7.0}, std::vector<double>{0.0, 0.0}, 3, found);
        QCOMPARE(found, (std::vector<double>{1.0, 1.0}));
    }
};

FAINTLINE_TEST(tst_medians)
#include "tst_medians.moc"
