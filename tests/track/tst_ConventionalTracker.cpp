#include "support/test.h"
#include "track/ConventionalTracker.h"

using namespace faintline;

namespace {

Grid line(Index cells)
{
    return {{{"range", "m", 0.0, 1.0, cells, false}}};
}

ConventionalSettings threeOfFive(double speed)
{
    return {10.0, 3, 5, speed, 1.0};
}

/// Frames of a line as strings: a digit is ten times itself, anything else is 1.
std::vector<Track> run(const std::vector<std::string> &frames, const ConventionalSettings &settings,
                       const Grid *grid = nullptr)
{
    ConventionalTracker tracker(grid ? *grid : line(Index(frames.front().size())), settings);
    Index frame = 0;
    for (const std::string &text : frames) {
        std::vector<float> y;
        for (const char c : text)
            y.push_back(c >= '2' && c <= '9' ? 10.0f * float(c - '0') : 1.0f);
        tracker.update(frame++, y);
    }
    return tracker.tracks();
}

} // namespace

class tst_ConventionalTracker : public QObject
{
    Q_OBJECT

private slots:
    void threeHitsOfFiveAreATrack()
    {
        const auto tracks = run({"2.......", ".3......", "........", "...4....", "........"}, threeOfFive(1.0));
        QCOMPARE(tracks.size(), std::size_t(1));
        QCOMPARE(tracks[0].onsetFrame, Index(0));
        QCOMPARE(tracks[0].detectFrame, Index(3));
        QCOMPARE(tracks[0].points.size(), std::size_t(3));
        QCOMPARE(tracks[0].points[2].cell, Index(3));
        QCOMPARE(tracks[0].peakStatistic, 30.0);
        QVERIFY(tracks[0].isOpen);
    }

    void theGateAdmitsTheLargestSpeedAndNoMore()
    {
        const std::vector<std::string> frames{"2.........", "..2.......", "....2....."};
        QCOMPARE(run(frames, threeOfFive(2.0)).size(), std::size_t(1));
        QVERIFY(run(frames, threeOfFive(1.9)).empty());
        // Two frames on, it is twice as wide.
        QCOMPARE(run({"2.........", "..........", "....2.....", "....2....."}, threeOfFive(2.0)).size(),
                 std::size_t(1));
    }

    void whatTakesTooLongIsNone()
    {
        QVERIFY(run({"2..", "...", "2..", "...", "...", "2.."}, threeOfFive(1.0)).empty());
        QCOMPARE(run({"2..", "...", "2..", "...", "2.."}, threeOfFive(1.0)).size(), std::size_t(1));
    }

    void anEndIsTheLastHit()
    {
        const auto tracks = run({"2..", "2..", "2..", "...", "...", "...", "..."}, threeOfFive(1.0));
        QCOMPARE(tracks.size(), std::size_t(1));
        QCOMPARE(tracks[0].endFrame, Index(2));
        QVERIFY(!tracks[0].isOpen);
    }

    void theStrongestHitIsTakenOnceAndByTheOldest()
    {
        const auto tracks = run({"2....", "2.3..", "2.3..", "2.3.."}, threeOfFive(5.0));
        // The first track goes over to the stronger hits, the second one gets what is left.
        QCOMPARE(tracks.size(), std::size_t(2));
        QCOMPARE(tracks[0].points[1].cell, Index(2));
        QCOMPARE(tracks[1].points[0].cell, Index(0));
        QCOMPARE(tracks[1].detectFrame, Index(3));
    }

    void bearingsGoRound()
    {
        const Grid grid{{{"range", "m", 0.0, 1.0, 1, false}, {"bearing", "°", 0.0, 90.0, 4, true}}};
        QCOMPARE(run({"2...", "...2", "..2."}, threeOfFive(1.0), &grid).size(), std::size_t(1));
        const Grid sector{{{"range", "m", 0.0, 1.0, 1, false}, {"bearing", "°", 0.0, 20.0, 4, false}}};
        QVERIFY(run({"2...", "...2", "..2."}, threeOfFive(1.0), &sector).empty());
    }

    void exactlyTheThresholdIsNoHit()
    {
        ConventionalSettings settings = threeOfFive(1.0);
        settings.hitThreshold = 20.0;
        QVERIFY(run({"2", "2", "2", "2"}, settings).empty());
    }
};

FAINTLINE_TEST(tst_ConventionalTracker)
#include "tst_ConventionalTracker.moc"
