#include "support/test.h"
#include "widgets/pings/PingMarks.h"

#include "pictures.h"

using namespace faintline;

/// Tracks, events and targets on range and bearing, as each axis alone sees them.
class tst_PingMarks : public QObject
{
    Q_OBJECT

private slots:
    void tracksAlongEachAxis()
    {
        const Track followed = track({{50, 3}, {52, 4}, {54, 4}});
        const auto ranges = tracksAlong({followed}, m_grid, 0);
        QCOMPARE(ranges.size(), std::size_t(1));
        QCOMPARE(cellsOf(ranges[0]), (std::vector<Index>{50, 52, 54}));
        const auto bearings = tracksAlong({followed}, m_grid, 1);
        QCOMPARE(cellsOf(bearings[0]), (std::vector<Index>{3, 4, 4}));
        QCOMPARE(bearings[0].id, 4);
    }

    void aTurnIsCutAtTheEndOfTheAxis()
    {
        const Track followed = track({{50, 18}, {50, 19}, {50, 0}, {50, 1}});
        const auto bearings = tracksAlong({followed}, m_grid, 1);
        QCOMPARE(bearings.size(), std::size_t(2)); // no stroke across the picture
        QCOMPARE(cellsOf(bearings[0]), (std::vector<Index>{18, 19}));
        QCOMPARE(cellsOf(bearings[1]), (std::vector<Index>{0, 1}));
        QCOMPARE(bearings[1].id, 4);
        QCOMPARE(tracksAlong({followed}, m_grid, 0).size(), std::size_t(1)); // range has no turn
    }

    void eventsAlongEachAxis()
    {
        Event event = test::event(4, 40.0, 120.0, 0.0);
        event.position = {1500.0, 72.0};
        event.ratesPerSecond = {-2.0, 0.5};
        event.driftPerSecond = 0.5;
        const auto ranges = eventsAlong({event}, 0);
        QCOMPARE(ranges[0].position, std::vector<double>{1500.0});
        QCOMPARE(ranges[0].driftPerSecond, -2.0);
        const auto bearings = eventsAlong({event}, 1);
        QCOMPARE(bearings[0].position, std::vector<double>{72.0});
        QCOMPARE(bearings[0].driftPerSecond, 0.5);
    }

    /// Events with a single axis stay as they are.
    void linesAreTheirOwnAxis()
    {
        Event line = test::event(1, 2.0, 8.0, 440.0);
        line.ratesPerSecond = {1.5};
        line.driftPerSecond = 1.5;
        const Event seen = eventsAlong({line}, 0).front();
        QCOMPARE(seen.position, line.position);
        QCOMPARE(seen.ratesPerSecond, line.ratesPerSecond);
        QCOMPARE(seen.driftPerSecond, line.driftPerSecond);
        QCOMPARE(seen.onsetSeconds, line.onsetSeconds);
    }

    void targetsBecomeLines()
    {
        PingTruth truth;
        truth.targets.push_back({12.0, 2, {1500.0, 1490.0, 1480.0}, {72.0, 73.0, 74.0}, {1004.0, 984.0, 964.0}});
        const auto ranges = truthAlong(truth, m_grid, m_time, 0);
        QCOMPARE(ranges.size(), std::size_t(1));
        QCOMPARE(ranges[0].startSeconds, 80.0); // of its first ping
        QCOMPARE(ranges[0].stepSeconds, 40.0);
        QCOMPARE(ranges[0].frequencyHz, (std::vector<double>{1500.0, 1490.0, 1480.0}));
        QCOMPARE(truthAlong(truth, m_grid, m_time, 1)[0].frequencyHz, (std::vector<double>{72.0, 73.0, 74.0}));
    }

    void targetsBeyondTheGridLeaveAGap()
    {
        PingTruth truth;
        truth.targets.push_back({12.0, 0, {1010.0, 990.0, 1010.0}, {72.0, 72.0, 72.0}, {24.0, -1.0, 24.0}});
        const auto ranges = truthAlong(truth, m_grid, m_time, 0);
        QCOMPARE(ranges.size(), std::size_t(2));
        QCOMPARE(ranges[0].frequencyHz.size(), std::size_t(1));
        QCOMPARE(ranges[1].startSeconds, 80.0);
    }

    void theOldestBoxIsOnTop()
    {
        PingMarks marks;
        // As the chain lists them, the oldest first.
        marks.boxes = {{2, 9, {1050.0, 1200.0}, {20.0, 60.0}}, {5, 3, {1000.0, 1100.0}, {0.0, 40.0}}};
        QCOMPARE(marks.boxAt({1075.0, 30.0})->pings, 9);
        QCOMPARE(marks.boxAt({1010.0, 10.0})->track, 5);
        QVERIFY(!marks.boxAt({1300.0, 30.0}));
    }

    void marksOnOtherAxes()
    {
        const Scan given = scan();
        const PingMarks marks = pingMarks(given.analysis, given.tracks, given.truth, 1, {3, 2, {}});
        QCOMPARE(marks.tracks.size(), std::size_t(1));
        QCOMPARE(marks.tracks[0].places.size(), std::size_t(2));
        QCOMPARE(marks.tracks[0].places[0].along, 20.0); // Doppler
        QCOMPARE(marks.tracks[0].places[0].across, 2.0); // elevation
        QCOMPARE(marks.tracks[0].places[1].across, 4.0);
        QCOMPARE(marks.detections[0].place.across, 4.0);
        QCOMPARE(marks.truth[0].places[0].along, 19.0); // as precisely as known
        QCOMPARE(marks.truth[0].places[0].across, 4.5);
        QCOMPARE(marks.boxes.size(), std::size_t(1));
        QCOMPARE(marks.boxes[0].along, (Span{-10.0, 50.0}));
        QCOMPARE(marks.boxes[0].across, (Span{1.0, 7.0}));
        // Across the bearings the box wraps.
        QCOMPARE(pingMarks(given.analysis, given.tracks, given.truth, 1, {0, 1, {}}).boxes.size(), std::size_t(2));
        // The same places over time.
        const Grid &grid = given.analysis.grid();
        QCOMPARE(tracksAlong(given.tracks, grid, 3)[0].points[1].cell, Index(3));
        QCOMPARE(truthAlong(given.truth, grid, given.analysis.time(), 2)[0].frequencyHz, std::vector<double>{4.5});
    }

    /// A cut shows what passes through its cell or a neighbour of it, on a cyclic axis the shorter way.
    void marksNearACut()
    {
        const Scan given = scan();
        const auto cutAt = [&](std::optional<Index> bearing, std::optional<Index> elevation) {
            return pingMarks(given.analysis, given.tracks, given.truth, 1, {0, 3, {{}, bearing, elevation, {}}});
        };
        QCOMPARE(cutAt({}, 2).tracks[0].places.size(), std::size_t(2)); // elevations 1 and 2
        QCOMPARE(cutAt({}, 3).tracks[0].places.size(), std::size_t(1));
        QVERIFY(cutAt({}, 4).tracks.empty() && cutAt({}, 4).truth.empty() && cutAt({}, 4).boxes.empty());
        QCOMPARE(cutAt(7, {}).tracks[0].places.size(), std::size_t(2)); // bearings 7 and 0 are neighbours
        QVERIFY(cutAt(3, {}).tracks.empty());
        QCOMPARE(cutAt({}, 3).boxes.size(), std::size_t(1));
        QCOMPARE(cutAt({}, 3).truth.size(), std::size_t(1));
    }

private:
    /// One ping of range × bearing × elevation × Doppler with a track, a target and an inhibited box.
    struct Scan {
        Analysis analysis;
        std::vector<Track> tracks;
        PingTruth truth;
    };
    static Scan scan()
    {
        Scan scan;
        const Grid grid{{{"range", "m", 1000.0, 10.0, 20, false},
                         {"bearing", "deg", 0.0, 45.0, 8, true},
                         {"elevation", "deg", 0.0, 2.0, 5, false},
                         {"Doppler", "m/s", -40.0, 20.0, 5, false}}};
        scan.analysis.frames = std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 1.0, 2, false}, grid,
                                                            std::vector<float>(std::size_t(2 * grid.size())));
        Track track;
        track.id = 7;
        track.onsetFrame = 0;
        track.detectFrame = track.endFrame = 1;
        track.points = {{0, grid.cell({4, 7, 1, 3}), 0, 5.0}, {1, grid.cell({5, 0, 2, 3}), 0, 9.0}};
        scan.tracks = {track};
        scan.truth.targets.push_back({9.0, 1, {1051.0}, {2.0}, {double(grid.cell({5, 0, 2, 3}))}, {4.5}, {19.0}});
        scan.analysis.inhibitions = {{}, {{7, {{5, 0, 2, 3}, {2, 1, 1, 1}}}}};
        return scan;
    }
    const Grid m_grid{{{"range", "m", 1000.0, 10.0, 100, false}, {"bearing", "deg", 0.0, 18.0, 20, true}}};
    const Axis m_time{"time", "s", 0.0, 40.0, 10, false};

    Track track(const std::vector<std::pair<Index, Index>> &cells) const
    {
        Track result;
        result.id = 4;
        for (std::size_t i = 0; i < cells.size(); ++i)
            result.points.push_back({Index(i), cells[i].first * 20 + cells[i].second, 0, 10.0});
        return result;
    }
    static std::vector<Index> cellsOf(const Track &track)
    {
        std::vector<Index> cells;
        for (const TrackPoint &point : track.points)
            cells.push_back(point.cell);
        return cells;
    }
};

FAINTLINE_WINDOW_TEST(tst_PingMarks)
#include "tst_PingMarks.moc"
