#include "base/Random.h"
#include "refine/relink.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>
#include <functional>

using namespace faintline;

namespace {

constexpr double binsPerCell = 2.0;
constexpr double threshold = 15.0;

/// A signal of that presence and level all along a way.
Bridge bridgeWith(const BridgeWay &way, float presence, float level)
{
    Bridge bridge;
    for (Index at = std::ssize(way.before); at < std::ssize(way.positions) - std::ssize(way.after); ++at) {
        const double position = way.positions[std::size_t(at)];
        bridge.points.push_back({position, float(position - 0.3), float(position + 0.3), presence, level});
        bridge.isSeen.push_back(true);
    }
    bridge.gain = presence > 0.5f ? 1.0 : -1.0;
    return bridge;
}

RelinkRule rule()
{
    RelinkRule result;
    result.threshold = threshold;
    result.binsPerCell = binsPerCell;
    result.cells = 1000;
    result.absence = [](double level) { return 0.5 * std::min(level, 4.0); };
    result.measure = [](std::span<const BridgeWay> ways) {
        std::vector<Bridge> bridges;
        for (const BridgeWay &way : ways)
            bridges.push_back(bridgeWith(way, 1.0f, 3.0f));
        return bridges;
    };
    return result;
}

using Way = std::function<double(Index)>;

/// A track from frame `first` to `last` along `way`, with errors of a tenth of a cell, that gains 1 nat a frame.
Track track(Index first, Index last, const Way &way, double level = 4.0, std::uint64_t seed = 1)
{
    Random random(seed, 0);
    Track result;
    result.onsetFrame = first;
    result.detectFrame = std::min(first + 10, last);
    result.endFrame = last;
    result.peakStatistic = double(last - first + 1);
    for (Index frame = first; frame <= last; ++frame) {
        const double position = way(frame) + 0.1 * random.normal();
        result.points.push_back({frame, Index(std::lround(position)), 0, double(frame - first + 1)});
        result.smoothed.push_back({position, float(position - 0.3), float(position + 0.3), 1.0f, float(level)});
    }
    return result;
}

Way straight(double at400, double slope)
{
    return [=](Index frame) { return at400 + slope * double(frame - 400); };
}

/// One way up to a frame, another one from there on.
Way changing(Index frame, const Way &before, const Way &after)
{
    return [=](Index at) { return at < frame ? before(at) : after(at); };
}

/// Largest distance from a way, cells of the axis.
double distance(const Track &track, const Way &way)
{
    double largest = 0.0;
    for (std::size_t i = 0; i < track.points.size(); ++i)
        largest = std::max(largest, std::abs(track.smoothed[i].position - way(track.points[i].frame)));
    return largest;
}

/// The track that begins nearest to a way.
const Track &trackAlong(const std::vector<Track> &tracks, const Way &way)
{
    return *std::min_element(tracks.begin(), tracks.end(), [&](const Track &a, const Track &b) {
        const auto from = [&](const Track &t) {
            return std::abs(t.smoothed.front().position - way(t.points.front().frame));
        };
        return from(a) < from(b);
    });
}

void checkFrames(const Track &track)
{
    QCOMPARE(track.points.size(), track.smoothed.size());
    for (std::size_t i = 0; i < track.points.size(); ++i)
        QCOMPARE(track.points[i].frame, track.onsetFrame + Index(i));
    QCOMPARE(track.points.back().frame, track.endFrame);
    QVERIFY(track.detectFrame >= track.onsetFrame && track.detectFrame <= track.endFrame);
}

} // namespace

/// Identities of tracks that met.
class tst_relink : public QObject
{
    Q_OBJECT

private slots:
    void aloneItStaysAsItIs();
    void thatCrossKeepTheirSlopes();
    void aSwapIsUndone();
    void curvesKissAndPart();
    void lostBehindAnotherItIsOne();
    void bridgesAreMeasured();
    void hiddenFramesAreNotReported();
    void evidenceAgainstAJoinPreventsIt_data();
    void evidenceAgainstAJoinPreventsIt();
    void switchedOffItIsTwo();
    void aGhostTakesNothing();
    void piecesHaveTheirOwnEvidence();
    void encountersKeepTheirEvidence();
};

void tst_relink::aloneItStaysAsItIs()
{
    const Track alone = track(0, 800, straight(300.0, 0.1));
    const auto result = relink({alone, track(0, 800, straight(500.0, 0.1), 4.0, 2)}, rule());
    QCOMPARE(result.size(), std::size_t(2));
    QCOMPARE(result.front().peakStatistic, alone.peakStatistic);
    QCOMPARE(distance(result.front(), straight(300.0, 0.1)), distance(alone, straight(300.0, 0.1)));
}

void tst_relink::thatCrossKeepTheirSlopes()
{
    const Way up = straight(300.0, 0.06);
    const Way flat = straight(300.0, 0.0);
    const auto result = relink({track(0, 800, up), track(0, 800, flat, 4.0, 2)}, rule());
    QCOMPARE(result.size(), std::size_t(2));
    QVERIFY(distance(trackAlong(result, up), up) < 1.0);
    QVERIFY(distance(trackAlong(result, flat), flat) < 1.0);
}

void tst_relink::aSwapIsUndone()
{
    const Way up = straight(300.0, 0.06);
    const Way flat = straight(300.0, 0.0);
    for (const Index swap : {370, 400, 425}) {
        const auto result =
            relink({track(0, 800, changing(swap, up, flat)), track(0, 800, changing(swap, flat, up), 4.0, 2)}, rule());
        QCOMPARE(result.size(), std::size_t(2));
        for (const Way &way : {up, flat}) {
            const Track &one = trackAlong(result, way);
            checkFrames(one);
            QVERIFY(distance(one, way) < 1.5);
            QVERIFY(one.peakStatistic > 500.0); // the sum of its pieces'
        }
    }
}

void tst_relink::curvesKissAndPart()
{
    const auto way = [](double side) {
        return [side](Index frame) { return 300.0 + side * (1.0 + 0.0005 * double((frame - 400) * (frame - 400))); };
    };
    const auto result = relink(
        {track(0, 800, changing(400, way(1.0), way(-1.0))), track(0, 800, changing(400, way(-1.0), way(1.0)), 4.0, 2)},
        rule());
    QCOMPARE(result.size(), std::size_t(2));
    for (const double side : {-1.0, 1.0})
        QVERIFY(distance(trackAlong(result, way(side)), way(side)) < 1.5);
}

void tst_relink::lostBehindAnotherItIsOne()
{
    const Way up = straight(300.0, 0.1);
    const Way flat = straight(300.0, 0.0);
    const auto result =
        relink({track(0, 800, flat, 20.0), track(0, 350, up, 4.0, 2), track(455, 800, up, 4.0, 3)}, rule());
    QCOMPARE(result.size(), std::size_t(2));
    const Track &one = trackAlong(result, up);
    checkFrames(one);
    QCOMPARE(one.onsetFrame, Index(0));
    QCOMPARE(one.endFrame, Index(800));
    QVERIFY(distance(one, up) < 1.5);
    QCOMPARE(one.detectFrame, Index(10));
}

// The line behind which one was lost is 7 dB stronger: what was measured of it is nothing of the other.
void tst_relink::bridgesAreMeasured()
{
    const Way up = straight(300.0, 0.1);
    const auto result = relink(
        {track(0, 800, straight(300.0, 0.0), 20.0), track(0, 350, up, 4.0, 2), track(455, 800, up, 4.0, 3)}, rule());
    const Track &one = trackAlong(result, up);
    QCOMPARE(one.points.size(), std::size_t(801));
    for (std::size_t i = 351; i < 455; ++i) {
        QCOMPARE(one.smoothed[i].level, 3.0f); // as measured, not as at the ends
        QCOMPARE(one.smoothed[i].presence, 1.0f);
    }
}

void tst_relink::hiddenFramesAreNotReported()
{
    const Way up = straight(300.0, 0.1);
    RelinkRule blind = rule();
    Index start = -1; // of the gap
    Index end = -1;
    constexpr Index seen = 395;
    blind.measure = [&](std::span<const BridgeWay> ways) {
        std::vector<Bridge> bridges;
        for (const BridgeWay &way : ways) {
            bridges.push_back(bridgeWith(way, 1.0f, 3.0f));
            start = way.firstFrame + std::ssize(way.before);
            end = start + way.gap();
            bridges.back().isSeen.assign(std::size_t(way.gap()), false);
            bridges.back().isSeen[std::size_t(seen - start)] = true;
        }
        return bridges;
    };
    const auto result = relink(
        {track(0, 800, straight(300.0, 0.0), 20.0), track(0, 350, up, 4.0, 2), track(455, 800, up, 4.0, 3)}, blind);
    const Track &one = trackAlong(result, up);
    QVERIFY(start > 300 && start <= 351 && end >= 455 && end < 500);
    for (Index frame = 0; frame <= 800; ++frame) {
        const bool wasTracked = frame <= 350 || frame >= 455;
        const bool isNear = frame < start + 12 || frame >= end - 12 || std::abs(frame - seen) <= 12;
        QCOMPARE(one.isPresent(std::size_t(frame)), wasTracked || isNear);
    }
}

void tst_relink::evidenceAgainstAJoinPreventsIt_data()
{
    QTest::addColumn<double>("absence"); // evidence in a stretch of frames
    QTest::addColumn<int>("seen");
    QTest::addColumn<double>("gain");
    QTest::addColumn<int>("tracks");
    QTest::newRow("there") << 2.0 << 104 << 5.0 << 2;
    QTest::newRow("absent for a while") << rule().threshold + 1.0 << 104 << 5.0 << 3;
    QTest::newRow("nothing in many frames") << 7.0 << 104 << -5.0 << 3;
    QTest::newRow("nothing in few frames") << 7.0 << 8 << -5.0 << 2;
}

// Among dense lines, the way between two pieces is nowhere far from a track; its own cells decide.
void tst_relink::evidenceAgainstAJoinPreventsIt()
{
    QFETCH(double, absence);
    QFETCH(int, seen);
    QFETCH(double, gain);
    QFETCH(int, tracks);
    const Way up = straight(300.0, 0.1);
    RelinkRule measuring = rule();
    measuring.measure = [&](std::span<const BridgeWay> ways) {
        std::vector<Bridge> bridges;
        for (const BridgeWay &way : ways) {
            bridges.push_back(bridgeWith(way, 1.0f, 3.0f));
            bridges.back().absence = absence;
            std::fill(bridges.back().isSeen.begin() + seen, bridges.back().isSeen.end(), false);
            bridges.back().gain = gain;
        }
        return bridges;
    };
    const auto result = relink(
        {track(0, 800, straight(300.0, 0.0), 20.0), track(0, 350, up, 4.0, 2), track(455, 800, up, 4.0, 3)}, measuring);
    QCOMPARE(int(result.size()), tracks);
}

void tst_relink::switchedOffItIsTwo()
{
    const Way flat = straight(300.0, 0.0);
    const auto pieces = [&](double level) {
        return relink({track(0, 390, flat, level), track(401, 800, flat, level, 2)}, rule()).size();
    };
    QCOMPARE(pieces(16.0), std::size_t(2)); // 10 frames of absence at 2 nat each
    QCOMPARE(pieces(1.0), std::size_t(1));  // at ½ nat each
}

void tst_relink::aGhostTakesNothing()
{
    const Way flat = straight(300.0, 0.0);
    const auto result = relink({track(0, 800, flat, 100.0), track(380, 420, straight(302.0, 0.0), 0.8, 2)}, rule());
    QCOMPARE(result.size(), std::size_t(2));
    const auto longest = std::max_element(
        result.begin(), result.end(), [](const Track &a, const Track &b) { return a.points.size() < b.points.size(); });
    QCOMPARE(longest->points.size(), std::size_t(801));
    QVERIFY(distance(*longest, flat) < 0.5);
}

void tst_relink::piecesHaveTheirOwnEvidence()
{
    // A track follows a line, and behind an encounter with another track something that is no continuation: steeper and
    // elsewhere. It stays one track: its own way is kept unless there is a better one.
    const Way way = changing(400, straight(300.0, 0.0), straight(306.0, 0.2));
    const auto kept = relink({track(0, 800, way), track(380, 420, straight(301.0, 0.0), 4.0, 2)}, rule());
    QCOMPARE(kept.size(), std::size_t(2));
    // If another track goes on from there, the rest is a track of its own, with what it gained.
    const auto parted = relink({track(0, 800, way), track(390, 800, straight(300.0, 0.0), 4.0, 2)}, rule());
    QCOMPARE(parted.size(), std::size_t(2));
    const Track &flat = trackAlong(parted, straight(300.0, 0.0));
    QVERIFY(distance(flat, straight(300.0, 0.0)) < 1.5);
    QCOMPARE(flat.endFrame, Index(800));
    for (const Track &one : parted) {
        checkFrames(one);
        QVERIFY(one.peakStatistic <= double(one.points.size()));
    }
}

// Two signals that are near each other for most of their time, as tones of keyed signals and steep whistles are: nearly
// all that was found of them was found in the encounter.
void tst_relink::encountersKeepTheirEvidence()
{
    const Way up = straight(300.0, 0.06);
    const Way flat = straight(300.0, 0.0);
    std::vector<Track> tracks{track(250, 550, changing(400, up, flat)),
                              track(250, 550, changing(400, flat, up), 4.0, 2)};
    double found = 0.0;
    for (Track &one : tracks) {
        double statistic = 0.0;
        for (TrackPoint &point : one.points)
            point.statistic = statistic += point.frame < 330 || point.frame > 470 ? 0.02 : 10.0;
        one.peakStatistic = statistic;
        found += statistic;
    }
    const auto result = relink(tracks, rule());
    QCOMPARE(result.size(), std::size_t(2));
    double kept = 0.0;
    for (const Track &one : result) {
        checkFrames(one);
        QVERIFY(std::abs(one.points.back().statistic - one.peakStatistic) < 1e-9);
        kept += one.peakStatistic;
    }
    for (const Way &way : {up, flat})
        QVERIFY(distance(trackAlong(result, way), way) < 1.5);
    QVERIFY2(std::abs(kept - found) < 1e-9, qPrintable(QString("%1 of %2").arg(kept).arg(found)));
}

FAINTLINE_TEST(tst_relink)
#include "tst_relink.moc"
