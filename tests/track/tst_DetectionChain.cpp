#include "base/Random.h"
#include "detect/Smd.h"
#include "support/test.h"
#include "track/Cluster.h"
#include "track/DetectionChain.h"

#include <cmath>
#include <ctime>

using namespace faintline;

namespace {

const Grid line64{{{"frequency", "Hz", 0.0, 1.0, 64, false}}};

MarkovModel model(Index cells, int slopes = 5)
{
    return {StateSpace({{"f",
                         cells,
                         false,
                         -(slopes / 2),
                         slopes,
                         slopes > 1 ? std::vector<double>{1.0 / 3.0, 1.0 / 3.0} : std::vector<double>{1.0},
                         {},
                         Rounding::HalfDown}}),
            Likelihood(LikelihoodKind::Rice, 0.5), 1.0};
}

ChainSettings settings(const Grid &grid, double threshold)
{
    ChainSettings chain;
    chain.threshold = threshold;
    chain.shoulder = threshold - 8.0;
    chain.linkCells.assign(grid.axes.size(), 3);
    chain.inhibitCells.assign(grid.axes.size(), 2);
    return chain;
}

/// Noise of mean 1 with constant-power lines laid over it: cell as a function of the frame, -1 where there is none.
struct Scene {
    Index cells;
    Index frames;
    std::vector<std::function<Index(Index)>> lines;
    double power = 12.0;

    std::vector<float> frame(Index t, Random &random) const
    {
        std::vector<float> y(static_cast<std::size_t>(cells));
        for (float &value : y)
            value = float(random.exponential());
        for (const auto &line : lines)
            if (const Index cell = line(t); cell >= 0)
                y[std::size_t(cell)] += float(power);
        return y;
    }
};

std::vector<Track> run(const Scene &scene, const ChainSettings &chainSettings, const Grid &grid,
                       std::vector<std::vector<float>> *shown = nullptr)
{
    const MarkovModel m = model(scene.cells);
    DetectionChain chain(m, grid, std::make_unique<Smd>(m, ResetRule{ResetLaw::Fixed, 0.69}), chainSettings);
    Random random(11, 1);
    std::vector<float> statistic(std::size_t(scene.cells));
    for (Index t = 0; t < scene.frames; ++t) {
        chain.update(t, scene.frame(t, random), statistic);
        if (shown)
            shown->push_back(statistic);
    }
    chain.finish();
    return chain.tracks();
}

} // namespace

/// Clustering, tracks from onset to end, inhibition, and the edges.
class tst_DetectionChain : public QObject
{
    Q_OBJECT

private slots:
    void clustersLinkNeighbours();
    void clustersKeepFlanks();
    void clustersWrap();
    void followsALineFromOnsetToEnd();
    void oneTrackForOneStrongLine();
    void twoLinesTwoTracks();
    void aStrongNeighbourIsNotStolen();
    void nothingIsSeenAtBlindPlaces();
    void noTrackWandersOntoABlindPlace();
    void severalFramesAtOnceChangeNoBit();
    void noTrackWithoutFeedback();
    void statisticIsAboveThresholdWhileTracked();
    void lineOffTheGridEnds();
    void noiseSeldomCrosses();
    void aStateDoesNotGrowWithATracksAge();
    void manyLinesCostLittleMoreThanTheirNumber();
    void onset_data();
    void onset();
};

void tst_DetectionChain::clustersLinkNeighbours()
{
    std::vector<float> d(64, 0.0f);
    d[10] = 12.0f;
    d[13] = 15.0f; // 3 away: linked
    d[17] = 11.0f; // 4 away: its own
    const auto clusters = findClusters(line64, d, 10.0, 10.0, {3});
    QCOMPARE(clusters.size(), std::size_t(2));
    QCOMPARE(clusters[0].peakCell, Index(13));
    QCOMPARE(clusters[0].cells, (std::vector<Index>{10, 13}));
    QCOMPARE(clusters[1].cells, (std::vector<Index>{17}));
    QVERIFY(findClusters(line64, d, 15.0, 15.0, {3}).empty()); // strictly greater
}

void tst_DetectionChain::clustersKeepFlanks()
{
    std::vector<float> d(64, 0.0f);
    for (int i = 0; i < 9; ++i)
        d[std::size_t(20 + i)] = float(12 - 2 * std::abs(i - 4));
    const auto clusters = findClusters(line64, d, 10.0, 5.0, {1});
    QCOMPARE(clusters.size(), std::size_t(1));
    QCOMPARE(clusters[0].cells, (std::vector<Index>{21, 22, 23, 24, 25, 26, 27}));
}

void tst_DetectionChain::clustersWrap()
{
    Grid ring = line64;
    ring.axes[0].cyclic = true;
    std::vector<float> d(64, 0.0f);
    d[0] = d[63] = 20.0f;
    QCOMPARE(findClusters(ring, d, 10.0, 10.0, {1}).size(), std::size_t(1));
    QCOMPARE(findClusters(line64, d, 10.0, 10.0, {1}).size(), std::size_t(2));
}

void tst_DetectionChain::followsALineFromOnsetToEnd()
{
    const auto line = [](Index t) { return t >= 50 && t < 150 ? Index(20 + (t - 50) / 5) : Index(-1); };
    const auto tracks = run({64, 300, {line}}, settings(line64, 15.0), line64);
    QCOMPARE(tracks.size(), std::size_t(1));
    const Track &track = tracks[0];
    QVERIFY2(std::abs(track.onsetFrame - 50) <= 1, qPrintable(QString::number(track.onsetFrame)));
    QVERIFY2(std::abs(track.endFrame - 149) <= 3, qPrintable(QString::number(track.endFrame)));
    QVERIFY(track.detectFrame >= 50 && track.detectFrame < 60);
    QVERIFY(!track.isOpen);
    int onLine = 0;
    for (std::size_t i = 0; i < track.points.size(); ++i) {
        QCOMPARE(track.points[i].frame, track.onsetFrame + Index(i)); // one point a frame
        onLine += std::abs(track.points[i].cell - line(std::clamp<Index>(track.points[i].frame, 50, 149))) <= 1 ? 1 : 0;
    }
    QVERIFY(onLine >= int(track.points.size()) - 2);
}

void tst_DetectionChain::oneTrackForOneStrongLine()
{
    Scene scene{64, 400, {[](Index t) { return t >= 20 ? Index(30) : Index(-1); }}, 1e5};
    const auto tracks = run(scene, settings(line64, 15.0), line64);
    QCOMPARE(tracks.size(), std::size_t(1));
    QVERIFY(tracks[0].isOpen);
    QCOMPARE(tracks[0].endFrame, Index(399));
    QVERIFY(tracks[0].peakStatistic > 1e4);
}

void tst_DetectionChain::twoLinesTwoTracks()
{
    Scene scene{64, 200, {[](Index) { return Index(20); }, [](Index) { return Index(32); }}};
    const auto tracks = run(scene, settings(line64, 15.0), line64);
    QCOMPARE(tracks.size(), std::size_t(2));
    QVERIFY(std::abs(tracks[0].points.back().cell - tracks[1].points.back().cell) >= 10);
}

void tst_DetectionChain::aStrongNeighbourIsNotStolen()
{
    // Two lines within one tracker's window: the younger, weaker one must keep to its own.
    Scene scene{64, 400, {[](Index) { return Index(30); }, [](Index) { return Index(37); }}};
    scene.lines.push_back(scene.lines[0]); // twice the power at 30
    const auto tracks = run(scene, settings(line64, 15.0), line64);
    QCOMPARE(tracks.size(), std::size_t(2));
    std::vector<Index> last{tracks[0].points.back().cell, tracks[1].points.back().cell};
    std::sort(last.begin(), last.end());
    QVERIFY(std::abs(last[0] - 30) <= 1 && std::abs(last[1] - 37) <= 1);
}

void tst_DetectionChain::nothingIsSeenAtBlindPlaces()
{
    // A line at a blind cell and one seven cells away, which its tracker keeps to.
    const Scene scene{64, 300, {[](Index) { return Index(0); }, [](Index) { return Index(7); }}};
    ChainSettings chain = settings(line64, 15.0);
    QCOMPARE(run(scene, chain, line64).size(), std::size_t(2));
    chain.excluded = {{0}};
    const auto tracks = run(scene, chain, line64);
    QCOMPARE(tracks.size(), std::size_t(1));
    for (const TrackPoint &point : tracks[0].points)
        QVERIFY(std::abs(point.cell - 7) <= 2);
}

void tst_DetectionChain::noTrackWandersOntoABlindPlace()
{
    // A line that ends ten cells away from a stronger one at a blind place, whose foot reaches six cells far.
    std::vector<std::function<Index(Index)>> lines;
    for (Index cell = 0; cell <= 6; ++cell)
        lines.push_back([cell](Index) { return cell; });
    lines.push_back([](Index t) { return t < 150 ? Index(10) : t < 160 ? Index(160 - t) : Index(-1); });
    ChainSettings chain = settings(line64, 15.0);
    chain.leakageExtent = [](double y) { return y > 1.0 ? Index(6) : Index(0); };
    chain.excluded = {{0}};
    const auto tracks = run({64, 400, lines}, chain, line64);
    QCOMPARE(tracks.size(), std::size_t(1));
    QVERIFY(tracks[0].endFrame < 180);
}

void tst_DetectionChain::severalFramesAtOnceChangeNoBit()
{
    // Quiet, then a line, then quiet again, with a blind place and two frames in which a cell was not observed.
    const Index cells = 700;
    const Index frames = 220;
    const Grid grid{{{"frequency", "Hz", 0.0, 1.0, cells, false}}};
    const Scene scene{cells, frames, {[](Index t) { return t >= 101 && t < 150 ? Index(300) : Index(-1); }}};
    const MarkovModel m = model(cells);
    ChainSettings chainSettings = settings(grid, 15.0);
    chainSettings.excluded = {{0}, {cells - 1}};
    const auto chain = [&] {
        return DetectionChain(m, grid, std::make_unique<Smd>(m, ResetRule{ResetLaw::Fixed, -0.9}), chainSettings);
    };
    Random random(12, 1);
    std::vector<float> y;
    for (Index t = 0; t < frames; ++t)
        std::ranges::copy(scene.frame(t, random), std::back_inserter(y));
    y[std::size_t(70 * cells + 400)] = y[std::size_t(71 * cells + 400)] = std::numeric_limits<float>::quiet_NaN();

    DetectionChain singly = chain();
    std::vector<float> expected(y.size());
    std::vector<double> continued;
    for (Index t = 0; t < frames; ++t) {
        singly.update(t, std::span(y).subspan(std::size_t(t * cells), std::size_t(cells)),
                      std::span(expected).subspan(std::size_t(t * cells), std::size_t(cells)));
        continued.push_back(singly.detector().regulation().continuedFraction);
    }
    DetectionChain together = chain();
    std::vector<float> found(y.size());
    std::vector<double> regulated;
    Index most = 0;
    for (Index t = 0; t < frames;) {
        const auto from = std::size_t(t * cells);
        const Index taken = together.updateSome(t, std::span(y).subspan(from), std::span(found).subspan(from));
        for (const PathDetector::Regulation &regulation : together.regulations())
            regulated.push_back(regulation.continuedFraction);
        most = std::max(most, taken);
        t += taken;
    }
    QCOMPARE(most, Index(16));
    QVERIFY(found == expected);
    QVERIFY(regulated == continued);
    QCOMPARE(together.inhibitions().size(), singly.inhibitions().size());
    singly.finish();
    together.finish();
    QCOMPARE(together.tracks().size(), std::size_t(1));
    QCOMPARE(together.tracks().front().onsetFrame, singly.tracks().front().onsetFrame);
    QCOMPARE(together.tracks().front().detectFrame, singly.tracks().front().detectFrame);
    QCOMPARE(together.tracks().front().endFrame, singly.tracks().front().endFrame);
}

void tst_DetectionChain::noTrackWithoutFeedback()
{
    ChainSettings chain = settings(line64, 15.0);
    chain.feedback = false;
    std::vector<std::vector<float>> shown;
    QVERIFY(run({64, 100, {[](Index) { return Index(20); }}}, chain, line64, &shown).empty());
    // The detector alone lets the peak grow and spread over the whole band.
    QVERIFY(*std::min_element(shown.back().begin(), shown.back().end()) > 15.0f);
}

void tst_DetectionChain::statisticIsAboveThresholdWhileTracked()
{
    std::vector<std::vector<float>> shown;
    const auto tracks = run({64, 200, {[](Index t) { return t < 120 ? Index(20) : Index(-1); }}},
                            settings(line64, 15.0), line64, &shown);
    QCOMPARE(tracks.size(), std::size_t(1));
    for (const TrackPoint &point : tracks[0].points)
        if (point.frame > tracks[0].detectFrame + 1)
            QVERIFY(shown[std::size_t(point.frame)][std::size_t(point.cell)] > 15.0f);
    // Away from the track there is nothing but noise: the peak does not spread.
    QVERIFY(shown[100][50] < 15.0f);
}

void tst_DetectionChain::lineOffTheGridEnds()
{
    const auto tracks =
        run({64, 200, {[](Index t) { return t < 63 ? Index(t) : Index(-1); }}}, settings(line64, 15.0), line64);
    QCOMPARE(tracks.size(), std::size_t(1));
    QVERIFY(tracks[0].endFrame >= 58 && tracks[0].endFrame <= 70);
    for (const TrackPoint &point : tracks[0].points)
        QVERIFY(point.cell >= 0 && point.cell < 64);
}

void tst_DetectionChain::noiseSeldomCrosses()
{
    QVERIFY(run({64, 2000, {}}, settings(line64, 25.0), line64).empty());
    QVERIFY(run({64, 2000, {}}, settings(line64, 4.0), line64).size() > 3); // and does where it should
}

void tst_DetectionChain::aStateDoesNotGrowWithATracksAge()
{
    const Scene scene{64, 6000, {[](Index) { return Index(30); }}};
    const MarkovModel m = model(scene.cells);
    const auto fresh = [&] {
        return std::make_unique<DetectionChain>(m, line64, std::make_unique<Smd>(m, ResetRule{ResetLaw::Fixed, 0.69}),
                                                settings(line64, 14.0));
    };
    const auto chain = fresh();
    Random random(11, 1);
    std::vector<float> statistic(64);
    std::vector<std::size_t> bytes;
    std::shared_ptr<const ChainState> young;
    std::vector<std::vector<float>> after;
    for (Index t = 0; t < scene.frames; ++t) {
        if (t % 1000 == 500) {
            QCOMPARE(chain->trackers().size(), std::size_t(1));
            bytes.push_back(chain->state()->bytes());
        }
        if (t == 5500)
            young = chain->state();
        const std::vector<float> y = scene.frame(t, random);
        chain->update(t, y, statistic);
        if (t >= 5500)
            after.push_back(y);
    }
    QCOMPARE(chain->trackers().front().age() > 5000, true);
    for (const std::size_t one : bytes)
        QVERIFY2(one < bytes.front() + 256 && bytes.front() < one + 256, qPrintable(QString::number(one)));
    // A small window, its scores and a handful of numbers, beside the states' scores.
    QVERIFY2(bytes.back() < 64 * 5 * sizeof(float) + 4096, qPrintable(QString::number(bytes.back())));
    // It goes on from there with the same bytes, and ends where the other ends.
    const auto resumed = fresh();
    resumed->setState(*young);
    std::vector<float> again(64);
    for (std::size_t i = 0; i < after.size(); ++i)
        resumed->update(5500 + Index(i), after[i], again);
    QCOMPARE(again, statistic);
    chain->finish();
    resumed->finish();
    QCOMPARE(resumed->tracks().back().endFrame, chain->tracks().back().endFrame);
    QCOMPARE(resumed->tracks().back().peakStatistic, chain->tracks().back().peakStatistic);
    QCOMPARE(resumed->tracks().back().detectFrame, chain->tracks().back().detectFrame);
}

void tst_DetectionChain::manyLinesCostLittleMoreThanTheirNumber()
{
    constexpr Index cells = 16000;
    constexpr Index frames = 60;
    const Grid grid{{{"frequency", "Hz", 0.0, 1.0, cells, false}}};
    const MarkovModel m = model(cells);
    const auto seconds = [&](Index lines) {
        Scene scene{cells, frames, {}};
        for (Index line = 0; line < lines; ++line)
            scene.lines.push_back([at = (line + 1) * 20 - 5](Index) { return at; });
        Random random(7, 1);
        std::vector<std::vector<float>> y;
        for (Index t = 0; t < frames; ++t)
            y.push_back(scene.frame(t, random));
        DetectionChain chain(m, grid, std::make_unique<Smd>(m, ResetRule{ResetLaw::Fixed, 0.69}), settings(grid, 14.0));
        std::vector<float> statistic(static_cast<std::size_t>(cells));
        for (Index t = 0; t < frames / 2; ++t)
            chain.update(t, y[std::size_t(t)], statistic);
        if (std::ssize(chain.trackers()) < lines)
            qFatal("not all lines are followed");
        const std::clock_t begin = std::clock();
        for (Index t = frames / 2; t < frames; ++t)
            chain.update(t, y[std::size_t(t)], statistic);
        return double(std::clock() - begin) / CLOCKS_PER_SEC;
    };
    double few = std::min(seconds(50), seconds(50));
    double many = std::min(seconds(800), seconds(800));
    QVERIFY2(many < 20.0 * few, qPrintable(QStringLiteral("%1 s for 50 lines, %2 s for 800").arg(few).arg(many)));
}

/// Where a path's score begins to grow, on scores that can be checked by eye.
void tst_DetectionChain::onset_data()
{
    QTest::addColumn<QList<double>>("scores");
    QTest::addColumn<int>("first");
    // Less half the mean growth, ½ nat a frame: 0, ½, -½, -1.3, 0, 1½.
    QTest::newRow("after noise") << QList<double>{1.0, 0.5, 0.2, 2.0, 4.0, 6.0} << 3;
    QTest::newRow("grows from the first frame") << QList<double>{1.0, 2.0, 3.0, 4.0} << 0;
    QTest::newRow("in the last frame only") << QList<double>{0.0, 0.0, 0.0, 8.0} << 3;
    QTest::newRow("one point") << QList<double>{5.0} << 0;
}

void tst_DetectionChain::onset()
{
    QFETCH(QList<double>, scores);
    QFETCH(int, first);
    std::vector<TrackPoint> points;
    for (const double score : scores)
        points.push_back({Index(points.size()), 7, 0, score});
    trimOnset(points);
    QCOMPARE(points.size(), std::size_t(scores.size() - first));
    QCOMPARE(points.front().frame, Index(first));
    QCOMPARE(points.back().statistic, scores.back());
}

FAINTLINE_TEST(tst_DetectionChain)
#include "tst_DetectionChain.moc"
