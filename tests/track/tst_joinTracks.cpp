#include "support/test.h"
#include "track/joinTracks.h"

using namespace faintline;

namespace {

const Grid line100{{{"frequency", "Hz", 0.0, 1.0, 100, false}}};

const JoinRule rule{15.0, 48, {3}, {2}, {12}};

/// A track from a frame on, through the given cells, that gathers `growth` nats a frame and is detected `after` frames.
Track track(Index onset, const std::vector<Index> &cells, double growth = 0.25, Index after = 10)
{
    Track result;
    result.onsetFrame = onset;
    result.detectFrame = onset + after;
    for (std::size_t i = 0; i < cells.size(); ++i)
        result.points.push_back({onset + Index(i), cells[i], 0, growth * double(i + 1)});
    result.endFrame = result.points.back().frame;
    result.peakStatistic = result.points.back().statistic;
    return result;
}

std::vector<Index> steady(Index cell, Index frames)
{
    return std::vector<Index>(std::size_t(frames), cell);
}

std::vector<Index> cellsOf(const Track &track)
{
    std::vector<Index> cells;
    for (const TrackPoint &point : track.points)
        cells.push_back(point.cell);
    return cells;
}

} // namespace

/// Pieces of one signal become one track, and other signals stay apart.
class tst_joinTracks : public QObject
{
    Q_OBJECT

private slots:
    void aGapIsBridged();
    void runUpOverTheEarlierTrackGoes();
    void signalsApartStayApart_data();
    void signalsApartStayApart();
    void threePiecesAreOneTrack();
    void theNearestGoesOn();
    void roundACyclicAxis();
};

void tst_joinTracks::aGapIsBridged()
{
    // Ends at frame 59 on cell 40; found again four cells higher after three frames.
    Track open = track(63, steady(44, 30), 0.5);
    open.isOpen = open.isConfirmed = true;
    const auto joined = joinTracks({track(0, steady(40, 60)), open}, line100, rule);
    QCOMPARE(joined.size(), std::size_t(1));
    const Track &one = joined.front();
    QCOMPARE(one.id, 1);
    QCOMPARE(one.onsetFrame, Index(0));
    QCOMPARE(one.detectFrame, Index(10));
    QCOMPARE(one.endFrame, Index(92));
    QCOMPARE(one.peakStatistic, 15.0);
    QVERIFY(one.isOpen && one.isConfirmed);
    QCOMPARE(std::ssize(one.points), Index(93));
    for (Index i = 0; i < 93; ++i)
        QCOMPARE(one.points[std::size_t(i)].frame, i);
    const std::vector<Index> cells = cellsOf(one);
    QCOMPARE(std::vector<Index>(cells.begin() + 59, cells.begin() + 64), (std::vector<Index>{40, 41, 42, 43, 44}));
}

void tst_joinTracks::runUpOverTheEarlierTrackGoes()
{
    // The later path begins five frames before the earlier one's end, far away, and comes to where that one ended.
    std::vector<Index> cells{70, 67, 64, 61, 58, 55, 52, 49, 46, 43, 40};
    cells.resize(40, 40);
    const auto joined = joinTracks({track(0, steady(40, 60)), track(55, cells)}, line100, rule);
    QCOMPARE(joined.size(), std::size_t(1));
    // Frame 62 is the first at which its cell, 49, could have been reached from 40 at frame 59: 9 ≤ 3 + 3·2.
    const std::vector<Index> path = cellsOf(joined.front());
    QCOMPARE(std::vector<Index>(path.begin() + 59, path.begin() + 66),
             (std::vector<Index>{40, 43, 46, 49, 46, 43, 40}));
    QCOMPARE(std::ssize(path), Index(95));
}

void tst_joinTracks::signalsApartStayApart_data()
{
    QTest::addColumn<Index>("onset");
    QTest::addColumn<Index>("cell");
    QTest::addColumn<double>("growth");
    QTest::addColumn<bool>("isJoined");
    QTest::newRow("within reach") << Index(65) << Index(52) << 0.25 << true;
    QTest::newRow("too far for a tracker") << Index(65) << Index(53) << 0.25 << false;
    QTest::newRow("after a long gap") << Index(107) << Index(40) << 0.25 << true;
    QTest::newRow("after too long a gap") << Index(108) << Index(40) << 0.25 << false;
    QTest::newRow("strong, but for a moment") << Index(64) << Index(40) << 3.0 << true;
    QTest::newRow("strong, and switched off") << Index(66) << Index(40) << 3.0 << false;
    QTest::newRow("detected while the other was there") << Index(49) << Index(40) << 0.25 << false;
}

void tst_joinTracks::signalsApartStayApart()
{
    QFETCH(Index, onset);
    QFETCH(Index, cell);
    QFETCH(double, growth);
    QFETCH(bool, isJoined);
    const auto joined =
        joinTracks({track(0, steady(40, 60), 3.0), track(onset, steady(cell, 60), growth)}, line100, rule);
    QCOMPARE(joined.size(), isJoined ? std::size_t(1) : std::size_t(2));
    for (std::size_t i = 0; i < joined.size(); ++i)
        QCOMPARE(joined[i].id, int(i) + 1);
}

void tst_joinTracks::threePiecesAreOneTrack()
{
    const auto joined =
        joinTracks({track(0, steady(40, 30)), track(35, steady(42, 30)), track(80, steady(41, 30))}, line100, rule);
    QCOMPARE(joined.size(), std::size_t(1));
    QCOMPARE(std::ssize(joined.front().points), Index(110));
}

void tst_joinTracks::theNearestGoesOn()
{
    // Both ended at frame 59; the later one is nearer to the second.
    const auto joined =
        joinTracks({track(0, steady(40, 60)), track(0, steady(50, 60)), track(64, steady(46, 30))}, line100, rule);
    QCOMPARE(joined.size(), std::size_t(2));
    QCOMPARE(joined[0].endFrame, Index(59));
    QCOMPARE(joined[1].endFrame, Index(93));
}

void tst_joinTracks::roundACyclicAxis()
{
    Grid bearings = line100;
    bearings.axes[0].cyclic = true;
    const auto joined = joinTracks({track(0, steady(98, 60)), track(63, steady(2, 30))}, bearings, rule);
    QCOMPARE(joined.size(), std::size_t(1));
    const std::vector<Index> cells = cellsOf(joined.front());
    QCOMPARE(std::vector<Index>(cells.begin() + 59, cells.begin() + 64), (std::vector<Index>{98, 99, 0, 1, 2}));
    QCOMPARE(joinTracks({track(0, steady(98, 60)), track(63, steady(2, 30))}, line100, rule).size(), std::size_t(2));
}

FAINTLINE_TEST(tst_joinTracks)
#include "tst_joinTracks.moc"
