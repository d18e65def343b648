#include "support/test.h"
#include "track/Area.h"

#include <algorithm>

using namespace faintline;

/// Areas that belong together, whatever the order they were found in.
class tst_Area : public QObject
{
    Q_OBJECT

private slots:
    void apartTheyStay();
    void touchingTheyJoin();
    void oneThatLinksOthers();
    void aBurstAndAHumStayTwo();
};

void tst_Area::apartTheyStay()
{
    const Area early{0, 9, 20, 30, 2.0};
    const Area besideIt{0, 9, 32, 40, 2.0};
    const Area late{11, 20, 20, 30, 2.0};
    QCOMPARE(joinAreas({late, besideIt, early}), (std::vector<Area>{early, besideIt, late}));
}

void tst_Area::touchingTheyJoin()
{
    const auto joined = joinAreas({{0, 9, 20, 30, 2.0}, {10, 39, 20, 31, 4.0}});
    QCOMPARE(joined, (std::vector<Area>{{0, 39, 20, 31, 3.5}})); // 10 frames of 2, 30 of 4
}

void tst_Area::oneThatLinksOthers()
{
    std::vector<Area> areas{{0, 9, 0, 9, 2.0}, {10, 29, 0, 9, 2.0}, {5, 15, 0, 8, 2.0}};
    for (int order = 0; order < 6; ++order) {
        const auto joined = joinAreas(areas);
        QCOMPARE(joined.size(), std::size_t(1));
        QCOMPARE(joined.front().lastFrame, Index(29));
        std::next_permutation(areas.begin(), areas.end(),
                              [](const Area &a, const Area &b) { return a.firstFrame < b.firstFrame; });
    }
}

void tst_Area::aBurstAndAHumStayTwo()
{
    QCOMPARE(joinAreas({{0, 9, 0, 99, 2.0}, {5, 99, 10, 20, 2.0}}).size(), std::size_t(2));
}

FAINTLINE_TEST(tst_Area)
#include "tst_Area.moc"
