#include "base/Random.h"
#include "support/test.h"
#include "track/closeTrackers.h"

using namespace faintline;

/// Who is near, against looking at all of them.
class tst_PlaceIndex : public QObject
{
    Q_OBJECT

private slots:
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

FAINTLINE_TEST(tst_PlaceIndex)
#include "tst_PlaceIndex.moc"
