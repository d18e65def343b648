#include "refine/relink.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

using namespace faintline;

namespace {

constexpr Index lastFrame = 400;

EncounterRule rule()
{
    EncounterRule result;
    result.near = 2.95;
    result.endNear = 6.0;
    result.fitFrames = 50;
    result.extension = 100;
    result.farthest = 3.0;
    return result;
}

using Way = std::function<double(Index)>;

/// A track from frame `first` to `last`, without errors.
Track track(const Way &way, Index first = 0, Index last = lastFrame)
{
    Track result;
    result.onsetFrame = first;
    result.endFrame = last;
    for (Index frame = first; frame <= last; ++frame) {
        const double position = way(frame);
        result.points.push_back({frame, Index(std::lround(position)), 0, 0.0});
        result.smoothed.push_back({position, float(position - 0.3), float(position + 0.3), 1.0f, 4.0f});
    }
    return result;
}

Way straight(double at200, double slope = 0.0)
{
    return [=](Index frame) { return at200 + slope * double(frame - 200); };
}

using Frames = std::vector<std::pair<Index, Index>>;

/// First and last frame of each run of marks.
Frames marked(const Track &track, const std::vector<bool> &marks)
{
    Frames runs;
    for (auto from = marks.begin(); (from = std::find(from, marks.end(), true)) != marks.end();) {
        const auto end = std::find(from, marks.end(), false);
        runs.emplace_back(track.onsetFrame + (from - marks.begin()), track.onsetFrame + (end - marks.begin()) - 1);
        from = end;
    }
    return runs;
}

} // namespace

/// Where tracks may have exchanged their signals.
class tst_encounters : public QObject
{
    Q_OBJECT

private slots:
    void farApartThereAreNone();
    void aCrossingLastsWhileTracksAreNear();
    void steepTracksCrossBetweenFrames();
    void meetingsCloseTogetherAreOne();
    void anEncounterIsWidened();
    void anEndBesideATrackIsOne();
    void theEndOfAnApproachBelongsToIt();
    void aLostSignalIsExpectedToContinue();
};

void tst_encounters::farApartThereAreNone()
{
    const std::vector<Track> tracks{track(straight(100.0)), track(straight(106.5))};
    for (const std::vector<bool> &marks : encounters(tracks, rule())) {
        QCOMPARE(marks.size(), std::size_t(lastFrame + 1));
        QCOMPARE(std::ranges::count(marks, true), 0);
    }
}

void tst_encounters::aCrossingLastsWhileTracksAreNear()
{
    const std::vector<Track> tracks{track(straight(100.0)), track(straight(100.0, 0.1)), track(straight(300.0))};
    const auto marks = encounters(tracks, rule());
    // 0.1·|frame - 200| < 2.95
    QCOMPARE(marked(tracks[0], marks[0]), (Frames{{171, 229}}));
    QCOMPARE(marked(tracks[1], marks[1]), (Frames{{171, 229}}));
    QCOMPARE(std::ranges::count(marks[2], true), 0);
}

void tst_encounters::steepTracksCrossBetweenFrames()
{
    // 4 cells on either side of the crossing: never nearer
    const std::vector<Track> tracks{track(straight(100.0)), track(straight(104.0, 8.0))};
    const auto marks = encounters(tracks, rule());
    QCOMPARE(marked(tracks[0], marks[0]), (Frames{{199, 200}}));
    QCOMPARE(marked(tracks[1], marks[1]), (Frames{{199, 200}}));
}

void tst_encounters::meetingsCloseTogetherAreOne()
{
    // The distance falls to 1 cell in every twentieth frame, and is 11 cells between.
    const Way wave = [](Index frame) { return 101.0 + std::abs(double((frame + 10) % 20) - 10.0); };
    const std::vector<Track> tracks{track(straight(100.0), 0, 60), track(wave, 0, 60)};
    EncounterRule between = rule();
    between.endNear = 0.0;
    between.joined = 10;
    QCOMPARE(marked(tracks[0], encounters(tracks, between).front()), (Frames{{0, 1}, {19, 21}, {39, 41}, {59, 60}}));
    between.joined = 20;
    QCOMPARE(marked(tracks[0], encounters(tracks, between).front()), (Frames{{0, 60}}));
}

void tst_encounters::anEncounterIsWidened()
{
    EncounterRule wide = rule();
    wide.widening = 20;
    const std::vector<Track> tracks{track(straight(100.0)), track(straight(100.0, 0.1))};
    QCOMPARE(marked(tracks[0], encounters(tracks, wide).front()), (Frames{{151, 249}}));
}

void tst_encounters::anEndBesideATrackIsOne()
{
    // 5 cells away: too far for an exchange on the way, but the signal of the track that ends may be the other one's.
    EncounterRule noExtension = rule();
    noExtension.extension = 0;
    const std::vector<Track> tracks{track(straight(100.0)), track(straight(105.0), 150, 250)};
    const auto marks = encounters(tracks, noExtension);
    QCOMPARE(marked(tracks[0], marks[0]), (Frames{{147, 153}, {247, 253}}));
    QCOMPARE(std::ranges::count(marks[1], true), 0); // nothing ends beside it while it is there
}

void tst_encounters::theEndOfAnApproachBelongsToIt()
{
    EncounterRule noExtension = rule();
    noExtension.extension = 0;
    // Its last 25 frames lie 4 cells beside the other track, which the signal itself approaches further.
    const Way deflected = [](Index frame) { return std::min(96.0, 100.0 + 0.1 * double(frame - 200)); };
    const std::vector<Track> tracks{track(straight(100.0)), track(deflected, 0, 184)};
    QCOMPARE(marked(tracks[1], encounters(tracks, noExtension)[1]), (Frames{{141, 184}})); // nearer than 6 cells
    const std::vector<Track> shorter{track(straight(100.0)), track(deflected, 117, 184)};  // 24 frames would remain
    QCOMPARE(marked(shorter[1], encounters(shorter, noExtension)[1]), Frames());
    const std::vector<Track> beside{track(straight(100.0)), track(straight(96.0), 50, 184)};
    QCOMPARE(marked(beside[1], encounters(beside, noExtension)[1]), Frames());
}

void tst_encounters::aLostSignalIsExpectedToContinue()
{
    // It approaches by 0.1 cell a frame and is lost 1 cell before the crossing.
    const std::vector<Track> lost{track(straight(100.0)), track(straight(100.0, 0.1), 0, 190)};
    QCOMPARE(marked(lost[0], encounters(lost, rule()).front()), (Frames{{171, 229}}));
    EncounterRule noExtension = rule();
    noExtension.extension = 0;
    QCOMPARE(marked(lost[0], encounters(lost, noExtension).front()), (Frames{{171, 193}}));
    // Likewise backward, for a signal that is found again.
    const std::vector<Track> found{track(straight(100.0)), track(straight(100.0, 0.1), 210)};
    QCOMPARE(marked(found[0], encounters(found, rule()).front()), (Frames{{171, 229}}));
}

FAINTLINE_TEST(tst_encounters)
#include "tst_encounters.moc"
