#include "refine/calls.h"
#include "support/test.h"

#include "base/Random.h"

#include <cmath>
#include <functional>
#include <numbers>

using namespace faintline;

namespace {

constexpr Index callFrames = 240;
constexpr double callBandHz = 4000.0;
constexpr double callBinHz = 2.0;

/// A plan with frames of 0 to 4 kHz in bins of 2 Hz, and a threshold of 12 nat.
AnalysisPlan planOfCalls(double lowestHz = 0.0)
{
    AnalysisPlan result;
    const Grid grid{{{"frequency", "Hz", lowestHz, callBinHz, Index(callBandHz / callBinHz), false}}};
    result.frames = std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 0.01, 1, false}, grid,
                                                 std::vector<float>(std::size_t(grid.size()), 1.0f));
    result.threshold = 12.0;
    return result;
}

using Way = std::function<double(Index frame)>; ///< Hz

/// A track along a way with errors of a fifth of a bin, alike over six frames.
Track trackAlong(const Way &way, int id, Index first = 0, Index count = callFrames)
{
    Track track;
    track.id = id;
    track.peakStatistic = 1000.0 - id;
    Random random(std::uint64_t(id), 0);
    double error = 0.0;
    for (Index frame = first; frame < first + count; ++frame) {
        if ((frame - first) % 6 == 0)
            error = 0.2 * random.normal();
        const double bin = way(frame) / callBinHz + error;
        track.points.push_back({frame, Index(std::lround(bin))});
        track.smoothed.push_back({bin, float(bin - 0.33), float(bin + 0.33), 1.0f, 10.0f});
    }
    track.takeEndsOfPoints();
    return track;
}

/// A voice of `hz` with a vibrato.
Way voice(double hz, double framesPerTurn, double number = 1.0)
{
    return [=](Index frame) {
        return number * hz * (1.0 + 0.03 * std::sin(2.0 * std::numbers::pi * double(frame) / framesPerTurn));
    };
}

Way steady(double hz)
{
    return [=](Index) { return hz; };
}

Way rising(double hz, double hzPerFrame)
{
    return [=](Index frame) { return hz + hzPerFrame * double(frame); };
}

} // namespace

/// Overtones of one source are one call.
class tst_calls : public QObject
{
    Q_OBJECT

private slots:
    void overtonesOfTwoVoices()
    {
        std::vector<Track> tracks;
        int id = 0;
        for (const int number : {2, 1, 3, 5})
            tracks.push_back(trackAlong(voice(310.0, 55.0, number), ++id));
        for (const int number : {1, 2})
            tracks.push_back(trackAlong(voice(731.0, 38.0, number), ++id));
        tracks.push_back(trackAlong(voice(1201.0, 23.0), ++id));
        QCOMPARE(callsOf(tracks, planOfCalls()), (std::vector<int>{1, 1, 1, 1, 5, 5, 0}));
    }

    void numberIsThatOfTheStrongest()
    {
        std::vector<Track> tracks{trackAlong(voice(310.0, 55.0), 1), trackAlong(voice(310.0, 55.0, 2.0), 2),
                                  trackAlong(voice(310.0, 55.0, 3.0), 3)};
        tracks[2].peakStatistic = 5000.0;
        QCOMPARE(callsOf(tracks, planOfCalls()), (std::vector<int>{3, 3, 3}));
    }

    void pairs_data()
    {
        QTest::addColumn<Way>("lower");
        QTest::addColumn<Way>("upper");
        QTest::addColumn<bool>("isCall");
        QTest::newRow("1 : 2, steady") << steady(500.0) << steady(1000.0) << true;
        QTest::newRow("1 : 2, straight") << rising(500.0, 0.5) << rising(1000.0, 1.0) << true;
        QTest::newRow("1 : 2, with a vibrato") << voice(500.0, 55.0) << voice(500.0, 55.0, 2.0) << true;
        QTest::newRow("5 : 7, with a vibrato") << voice(100.0, 55.0, 5.0) << voice(100.0, 55.0, 7.0) << true;
        QTest::newRow("1 : 2.02, steady") << steady(500.0) << steady(1010.0) << false;
        QTest::newRow("1 : 2.02, with a vibrato") << voice(500.0, 55.0) << voice(500.0, 55.0, 2.02) << false;
        QTest::newRow("1 : 2 with another slope") << rising(500.0, 0.5) << rising(880.0, 2.0) << false;
        QTest::newRow("1 : 2 with another vibrato") << voice(500.0, 55.0) << voice(500.0, 50.0, 2.0) << false;
        QTest::newRow("one of 1 : 2 is steady") << voice(500.0, 55.0) << steady(1000.0) << false;
        QTest::newRow("beside each other") << voice(500.0, 55.0) << voice(520.0, 55.0) << false;
    }

    void pairs()
    {
        QFETCH(Way, lower);
        QFETCH(Way, upper);
        QFETCH(bool, isCall);
        const int call = isCall ? 1 : 0;
        QCOMPARE(callsOf({trackAlong(lower, 1), trackAlong(upper, 2)}, planOfCalls()), (std::vector<int>{call, call}));
    }

    /// Among thirty others one overtone may be chance, but not four.
    void moreAmongOthers()
    {
        std::vector<Track> tracks{trackAlong(steady(301.0), 1), trackAlong(steady(602.0), 2)};
        Random random(3, 0);
        for (int id = 6; id < 36; ++id)
            tracks.push_back(trackAlong(steady(200.0 + 3500.0 * random.uniform()), id));
        QCOMPARE(callsOf(tracks, planOfCalls()), std::vector<int>(tracks.size(), 0));
        for (const int number : {3, 4, 5})
            tracks.push_back(trackAlong(steady(301.0 * number), number));
        const std::vector<int> calls = callsOf(tracks, planOfCalls());
        QCOMPARE(std::ranges::count(calls, 1), 5);
        QCOMPARE(std::ranges::count(calls, 0), 30);
    }

    void nothingInCommon()
    {
        const Way lower = voice(310.0, 55.0);
        const Way upper = voice(310.0, 55.0, 2.0);
        QCOMPARE(callsOf({trackAlong(lower, 1, 0, 100), trackAlong(upper, 2, 100, 100)}, planOfCalls()),
                 (std::vector<int>{0, 0}));
        Track absent = trackAlong(upper, 2);
        for (SmoothedPoint &point : absent.smoothed)
            point.presence = 0.1f;
        QCOMPARE(callsOf({trackAlong(lower, 1), absent}, planOfCalls()), (std::vector<int>{0, 0}));
    }

    void noOvertonesOfZero()
    {
        std::vector<Track> tracks{trackAlong(steady(2.0), 1), trackAlong(steady(2.0), 2)};
        for (Track &track : tracks)
            for (SmoothedPoint &point : track.smoothed)
                point.position = 0.0;
        QCOMPARE(callsOf(tracks, planOfCalls()), (std::vector<int>{0, 0}));
    }

    /// Offsets from a centre frequency have no overtones, and live events are told one by one.
    void whereThereAreNone()
    {
        const std::vector<Track> tracks{trackAlong(voice(310.0, 55.0), 1), trackAlong(voice(310.0, 55.0, 2.0), 2)};
        QCOMPARE(callsOf(tracks, planOfCalls()), (std::vector<int>{1, 1}));
        QCOMPARE(callsOf(tracks, planOfCalls(-2000.0)), (std::vector<int>{0, 0}));
        AnalysisPlan live = planOfCalls();
        live.settings.noise.causal = true;
        QCOMPARE(callsOf(tracks, live), (std::vector<int>{0, 0}));
        std::vector<Track> causal = tracks;
        causal[0].smoothed.clear();
        QCOMPARE(callsOf(causal, planOfCalls()), (std::vector<int>{0, 0}));
    }

    void chanceMakesHardlyAnyCalls_data()
    {
        QTest::addColumn<double>("rateHz");
        QTest::newRow("steady lines") << 0.0;
        QTest::newRow("lines that wander") << 0.3;
    }

    /// Signals each for themselves; e^-3.3 of such recordings have a call.
    void chanceMakesHardlyAnyCalls()
    {
        QFETCH(double, rateHz);
        int recordingsWithCalls = 0;
        for (std::uint64_t recording = 0; recording < 20; ++recording) {
            std::vector<Track> tracks;
            for (int id = 1; id <= 120; ++id) {
                Random random(std::uint64_t(id), 7 + recording);
                std::vector<double> hz{200.0 + 3500.0 * random.uniform()};
                double rate = 0.0;
                while (std::ssize(hz) < callFrames)
                    hz.push_back(
                        std::clamp(hz.back() + (rate = 0.95 * rate + rateHz * random.normal()), 100.0, 3900.0));
                tracks.push_back(trackAlong([hz](Index frame) { return hz[std::size_t(frame)]; }, id));
            }
            recordingsWithCalls +=
                std::ranges::any_of(callsOf(tracks, planOfCalls()), [](int call) { return call > 0; });
        }
        QVERIFY2(recordingsWithCalls <= 3, qPrintable(QString::number(recordingsWithCalls)));
    }
};

FAINTLINE_TEST(tst_calls)
#include "tst_calls.moc"
