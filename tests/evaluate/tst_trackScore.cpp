#include "evaluate/comparison/trackScore.h"
#include "support/test.h"

using namespace faintline;

namespace {

const Grid grid{{{"range", "m", 0.0, 1.0, 100, false}, {"bearing", "°", 0.0, 36.0, 10, true}}};

Index at(Index range, Index beam)
{
    return range * 10 + beam;
}

/// Ten pings from ping 5 on, one range cell a ping from range 20, in one beam.
TruthTarget target(Index beam)
{
    TruthTarget truth;
    truth.firstPing = 5;
    for (Index k = 0; k < 10; ++k) {
        truth.rangeMetres.push_back(double(20 + k));
        truth.bearingDegrees.push_back(36.0 * double(beam));
        truth.cell.push_back(double(at(20 + k, beam)));
    }
    return truth;
}

/// A track from `detect` to `last` beside such a target, onset two frames earlier.
Track track(Index detect, Index last, Index beam, Index rangeOffset)
{
    Track made;
    made.onsetFrame = detect - 2;
    made.detectFrame = detect;
    made.endFrame = last;
    for (Index frame = detect - 2; frame <= last; ++frame)
        made.points.push_back({frame, at(15 + frame + rangeOffset, beam), 0, 0.0});
    return made;
}

} // namespace

/// Tracks against truth, small enough to count by hand.
class tst_trackScore : public QObject
{
    Q_OBJECT

private slots:
    void followedExactly()
    {
        Track own = track(8, 14, 3, 0);
        own.isConfirmed = true;
        own.confirmFrame = 10;
        const TrackScore score = scoreTracks(std::vector{own}, {{target(3)}}, grid, {3, 1});
        QCOMPARE(score.targets[0].tracks, 1);
        QCOMPARE(score.targets[0].detectLatency, Index(4)); // found in its fourth ping
        QCOMPARE(score.targets[0].confirmLatency, Index(6));
        QCOMPARE(score.targets[0].matchedPoints, Index(7));
        QCOMPARE(score.targets[0].presentPings, Index(10));
        QCOMPARE(score.targets[0].rmsCells, (std::vector<double>{0.0, 0.0}));
        QCOMPARE(score.falseTracks, 0);
    }

    void besideAndAcrossTheWrap()
    {
        const TrackScore score = scoreTracks(std::vector{track(8, 14, 9, 2)}, {{target(0)}}, grid, {3, 1});
        QCOMPARE(score.targets[0].tracks, 1);
        QCOMPARE(score.targets[0].rmsCells, (std::vector<double>{2.0, 1.0}));
    }

    void tooFarIsFalse()
    {
        Track far = track(8, 14, 3, 4);
        far.isConfirmed = true;
        const TrackScore score = scoreTracks(std::vector{far, track(8, 14, 5, 0)}, {{target(3)}}, grid, {3, 1});
        QCOMPARE(score.targets[0].tracks, 0);
        QVERIFY(!score.targets[0].isDetected());
        QCOMPARE(score.falseTracks, 2);
        QCOMPARE(score.falseConfirmed, 1);
        QCOMPARE(score.targetOfTrack, (std::vector<int>{-1, -1}));
    }

    void afterItsEndIsNotHeldAgainstIt()
    {
        // Three points on the target, thirty after its end.
        const TrackScore score = scoreTracks(std::vector{track(12, 44, 3, 0)}, {{target(3)}}, grid, {3, 1});
        QCOMPARE(score.targets[0].tracks, 1);
        QCOMPARE(score.targets[0].matchedPoints, Index(3));
    }

    void theEarliestTrackCounts()
    {
        const TrackScore score =
            scoreTracks(std::vector{track(12, 14, 3, 0), track(7, 10, 3, 1)}, {{target(3)}}, grid, {3, 1});
        QCOMPARE(score.targets[0].tracks, 2);
        QCOMPARE(score.targets[0].detectLatency, Index(3));
        QVERIFY(!score.targets[0].isConfirmed());
    }

    void twoTargetsTwoTracks()
    {
        const TrackScore score =
            scoreTracks(std::vector{track(8, 14, 7, 0), track(8, 14, 3, 0)}, {{target(3), target(7)}}, grid, {3, 1});
        QCOMPARE(score.targetOfTrack, (std::vector<int>{1, 0}));
    }

    void nothingFound()
    {
        const TrackScore score = scoreTracks({}, {{target(3)}}, grid, {3, 1});
        QCOMPARE(score.targets[0].detectLatency, Index(-1));
        QCOMPARE(score.falseTracks, 0);
    }

    void histograms()
    {
        const std::vector<Index> latencies{1, 3, 3, -1, 9, 4};
        QCOMPARE(latencyHistogram(latencies, 4), (std::vector<int>{1, 0, 2, 1, 2}));
        QCOMPARE(pdAgainstPings(latencies, 4), (std::vector<double>{1.0 / 6.0, 1.0 / 6.0, 0.5, 4.0 / 6.0}));
    }
};

FAINTLINE_TEST(tst_trackScore)
#include "tst_trackScore.moc"
