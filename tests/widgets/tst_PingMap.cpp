// The map of one ping, as a plane and from above, and its marks.

#include "support/test.h"
#include "widgets/pings/PingMap.h"

#include "pingPictures.h"
#include "pixels.h"
#include "widgets/base/Theme.h"
#include "widgets/pings/PingViewports.h"
#include "widgets/pings/PolarItem.h"
#include "widgets/pings/PolarView.h"

#include <qwt_plot_canvas.h>
#include <qwt_text.h>

#include <QImage>

#include <cmath>

using namespace faintline;
using namespace faintline::test;

namespace {

Grid grid()
{
    return {{rangeAxis, bearingAxis}};
}

/// A map that is seen, of a ping with one bright cell.
struct ShownMap {
    ShownMap()
    {
        viewport.setExtents({995.0, 1495.0}, {-22.5, 337.5}, 40.0, 90.0);
        map.setPicture(pingPicture(10, 3), bearingAxis);
        test::show(map, {500, 400});
    }

    Viewport viewport;
    PingMap map{"Statistic", viewport};
};

Track track(int id, std::vector<std::pair<Index, Index>> cells, Index first = 0)
{
    Track result;
    result.id = id;
    result.onsetFrame = first;
    result.detectFrame = first + 1;
    result.isConfirmed = true;
    result.confirmFrame = first + 2;
    for (const auto &[range, beam] : cells)
        result.points.push_back({first++, range * beams + beam, 0, 0.0});
    result.endFrame = first - 1;
    return result;
}

/// An analysis of six pings with nothing in it but the grid and what was inhibited.
Analysis sixPings()
{
    Analysis analysis;
    analysis.frames = std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 40.0, 6, false}, grid(),
                                                   std::vector<float>(6 * ranges * beams));
    analysis.inhibitions.resize(6);
    return analysis;
}

} // namespace

class tst_PingMap : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    // ---- marks ----

    void aTrailEndsAtThisPing()
    {
        const std::vector<Track> tracks{track(4, {{10, 3}, {12, 3}, {14, 4}, {16, 4}}, 1)};
        const Analysis analysis = sixPings();
        QVERIFY(pingMarks(analysis, tracks, {}, 0).tracks.empty());
        QVERIFY(pingMarks(analysis, tracks, {}, 5).tracks.empty());
        const PingMarks marks = pingMarks(analysis, tracks, {}, 3);
        QCOMPARE(marks.tracks.size(), std::size_t(1));
        QCOMPARE(marks.tracks[0].id, 4);
        QCOMPARE(marks.tracks[0].places.size(), std::size_t(3));
        QCOMPARE(marks.tracks[0].places.back().along, 1140.0);
        QCOMPARE(marks.tracks[0].places.back().across, 180.0);
        QVERIFY(marks.tracks[0].isConfirmed);
        QVERIFY(marks.detections.empty());
        QCOMPARE(pingMarks(analysis, tracks, {}, 3, {}, 2).tracks[0].places.size(), std::size_t(2)); // a shorter tail
        // Before its detection it is known only by hindsight.
        QVERIFY(!pingMarks(analysis, tracks, {}, 1).tracks[0].isDetected);
        QCOMPARE(pingMarks(analysis, tracks, {}, 2).detections.size(), std::size_t(1));
        QVERIFY(!pingMarks(analysis, tracks, {}, 2).tracks[0].isConfirmed);
    }

    void aBoxTellsForWhomAndHowLong()
    {
        Analysis analysis = sixPings();
        for (const std::size_t ping : {1u, 3u, 4u, 5u})
            analysis.inhibitions[ping].push_back({7, CellBox{{20, 0}, {3, 1}}}); // over the end of the bearings
        const PingMarks marks = pingMarks(analysis, {}, {}, 5);
        QCOMPARE(marks.boxes.size(), std::size_t(2));
        const PingMarks::Box *west = marks.boxAt({1200.0, 315.0});
        const PingMarks::Box *east = marks.boxAt({1230.0, 45.0});
        QVERIFY(west && east && west != east);
        QCOMPARE(west->track, 7);
        QCOMPARE(west->pings, 3); // the one before was another time
        QCOMPARE(east->along.low, 1165.0);
        QCOMPARE(east->along.high, 1235.0);
        QVERIFY(!marks.boxAt({1200.0, 90.0}));
        QVERIFY(!marks.boxAt({1240.0, 0.0}));
        QVERIFY(pingMarks(analysis, {}, {}, 2).boxes.empty());
        analysis.settings.decide.inhibits = false; // then nothing is kept from the detector
        QVERIFY(pingMarks(analysis, {}, {}, 5).boxes.empty());
    }

    void truthIsThereWhileItFillsACell()
    {
        PingTruth truth;
        truth.targets.push_back({7.0, 1, {1100.0, 1110.0, 1600.0}, {10.0, 12.0, 14.0}, {80.0, 88.0, -1.0}});
        const Analysis analysis = sixPings();
        QVERIFY(pingMarks(analysis, {}, truth, 0).truth.empty());
        const PingMarks marks = pingMarks(analysis, {}, truth, 2);
        QCOMPARE(marks.truth.size(), std::size_t(1));
        QCOMPARE(marks.truth[0].places.back().along, 1110.0);
        QVERIFY(pingMarks(analysis, {}, truth, 3).truth.empty()); // beyond the ranges
        const auto lines = truthAlong(truth, grid(), analysis.time(), 1);
        QCOMPARE(lines.size(), std::size_t(1));
        QCOMPARE(lines[0].startSeconds, 40.0);
        QCOMPARE(lines[0].endSeconds, 80.0);
        QCOMPARE(lines[0].frequencyHz, (std::vector<double>{10.0, 12.0}));
    }

    void alongABearingPathsAreCutAtTheTurn()
    {
        const std::vector<Track> tracks{track(1, {{10, 6}, {11, 7}, {12, 0}, {13, 1}})};
        const auto bearings = tracksAlong(tracks, grid(), 1);
        QCOMPARE(bearings.size(), std::size_t(2));
        QCOMPARE(bearings[0].points.size(), std::size_t(2));
        QCOMPARE(bearings[1].points.front().cell, Index(0));
        QCOMPARE(bearings[1].id, 1);
        const auto along = tracksAlong(tracks, grid(), 0);
        QCOMPARE(along.size(), std::size_t(1));
        QCOMPARE(along[0].points[3].cell, Index(13));
    }

    // ---- viewports ----

    void whoeverZoomsZoomsAll()
    {
        Viewport rangeTime;
        PingViewports viewports(rangeTime);
        viewports.setExtents({{-20.0, 220.0}, 40.0}, {{{995.0, 1495.0}, 40.0}, {{-22.5, 337.5}, 45.0}});
        viewports.map().zoomTo({1100.0, 1200.0}, {0.0, 90.0});
        QCOMPARE(rangeTime.frequency().low, 1100.0);
        QCOMPARE(viewports.acrossTime().frequency().high, 90.0);
        QCOMPARE(rangeTime.time(), (Span{-20.0, 220.0}));
        viewports.acrossTime().zoomTo({40.0, 120.0}, {0.0, 180.0});
        QCOMPARE(rangeTime.time(), (Span{40.0, 120.0}));
        QCOMPARE(viewports.map().frequency(), (Span{0.0, 180.0}));
        QCOMPARE(viewports.map().time(), (Span{1100.0, 1200.0}));
    }

    void oneCursorForAll()
    {
        Viewport rangeTime;
        PingViewports viewports(rangeTime);
        viewports.setExtents({{-20.0, 220.0}, 40.0}, {{{995.0, 1495.0}, 40.0}, {{-22.5, 337.5}, 45.0}});
        QSignalSpy changed(&viewports, &PingViewports::placeChanged);
        viewports.setPlace({80.0, {1200.0, 90.0}});
        QCOMPARE(changed.count(), 1);
        viewports.map().setCursor({1300.0, 45.0});
        QCOMPARE(changed.count(), 2);
        QVERIFY(rangeTime.cursor() == (Viewport::Point{80.0, 1300.0}));
        QVERIFY(viewports.acrossTime().cursor() == (Viewport::Point{80.0, 45.0}));
        viewports.acrossTime().setCursor({120.0, 300.0});
        QVERIFY(viewports.place() == (PingViewports::Place{120.0, {1300.0, 300.0}}));
        QVERIFY(viewports.map().cursor() == (Viewport::Point{1300.0, 300.0}));
    }

    // ---- pictures ----

    void fromAboveACellIsWhereItsBearingPoints()
    {
        PolarItem item;
        item.setPicture(pingPicture(40, 2), grid().axes[1]); // 1400 m, 90°: east
        item.setColours({&ColourMap::named("grey"), {0.0, 30.0}});
        item.setGround(Qt::blue);
        const QImage image = item.image({-1500.0, 1500.0}, {-1500.0, 1500.0}, {300, 300});
        QCOMPARE(QColor(image.pixel(150, 150)), QColor(Qt::blue)); // nearer than the first range
        QCOMPARE(QColor(image.pixel(1, 1)), QColor(Qt::blue));     // beyond the last one
        QCOMPARE(image.pixel(150 + 139, 150), ColourMap::named("grey").at(1.0));
        QVERIFY(image.pixel(150, 150 - 139) != image.pixel(150 + 139, 150));
        QVERIFY(image.pixel(150 - 139, 150) != image.pixel(150 + 139, 150));
    }

    void oneCellSurvivesManyToAPixel()
    {
        PolarItem item;
        item.setPicture(pingPicture(23, 0), grid().axes[1]);
        item.setColours({&ColourMap::named("grey"), {0.0, 30.0}});
        const QImage image = item.image({-1500.0, 1500.0}, {-1500.0, 1500.0}, {60, 60}); // five ranges a pixel
        bool isFound = false;
        for (int y = 0; y < 30; ++y)
            isFound = isFound || image.pixel(30, y) == ColourMap::named("grey").at(1.0);
        QVERIFY(isFound);
    }

    void keyPLooksFromAboveAndBack()
    {
        ShownMap shown;
        PingMap &map = shown.map;
        QSignalSpy changed(&map.plane()->display(), &PictureDisplay::projectionChanged);
        QTest::keyClick(map.plane(), Qt::Key_P);
        QVERIFY(map.isPolar());
        QCOMPARE(changed.count(), 1);
        QTest::keyClick(map.polar(), Qt::Key_P);
        QVERIFY(!map.isPolar());
        QCOMPARE(changed.count(), 2);
        QTest::keyClick(map.plane(), Qt::Key_P, Qt::ControlModifier); // another command's
        QVERIFY(!map.isPolar());
    }

    void fromAboveAClickFindsItsCell()
    {
        ShownMap shown;
        const Viewport &viewport = shown.viewport;
        shown.map.plane()->display().setPolar(true);
        QCoreApplication::processEvents();
        PolarView &polar = *shown.map.polar();
        const QPointF at = polar.positionOf({1250.0, 225.0});
        QTest::mouseClick(polar.canvas(), Qt::LeftButton, {}, at.toPoint());
        QVERIFY(viewport.cursor());
        QVERIFY(std::abs(viewport.cursor()->seconds - 1250.0) < 15.0);
        QVERIFY(std::abs(viewport.cursor()->hz - 225.0) < 2.0);
        // As high as wide, to a pixel.
        const QPointF origin = polar.positionOf({0.0, 0.0});
        const QPointF north = polar.positionOf({1000.0, 0.0}) - origin,
                      east = polar.positionOf({1000.0, 90.0}) - origin;
        QVERIFY(std::abs(std::hypot(north.x(), north.y()) - std::hypot(east.x(), east.y())) < 1.0);
        QVERIFY(north.y() < 0.0 && east.x() > 0.0);
        // A click in the hole changes nothing.
        QTest::mouseClick(polar.canvas(), Qt::LeftButton, {}, origin.toPoint());
        QVERIFY(std::abs(viewport.cursor()->seconds - 1250.0) < 15.0);
    }

    void thePlaneIsLabelledByItsAxes()
    {
        const ShownMap shown;
        const WaterfallView &plane = *shown.map.plane();
        QCOMPARE(plane.axisTitle(QwtAxis::YLeft).text(), "Range (m)");
        QCOMPARE(plane.axisTitle(QwtAxis::XBottom).text(), "Bearing (°)");
        QCOMPARE(*plane.valueAt(1100.0, 135.0), 30.0);
    }

    void theNextPingKeepsItsColours()
    {
        ShownMap shown;
        PingMap &map = shown.map;
        const Span range = map.plane()->range();
        std::vector<float> louder(std::size_t(ranges * beams));
        for (std::size_t i = 0; i < louder.size(); ++i)
            louder[i] = 40.0f + float(i % 40);
        map.setPicture(pictureOf(grid().axes[0], grid().axes[1], louder, ByteScale(ByteScale::Kind::ScoreNats)),
                       grid().axes[1]);
        QCOMPARE(map.plane()->range(), range);
        QVERIFY(map.plane()->isRangeAutomatic());
        map.plane()->setAutomaticRange();
        QVERIFY(!(map.plane()->range() == range));
    }

    void marksChangePixelsInBothViews()
    {
        ShownMap shown;
        PingMap &map = shown.map;
        const PingMarks marks = pingMarks(sixPings(), {track(1, {{20, 6}, {24, 7}, {28, 0}, {32, 1}})}, {}, 3);
        for (const bool isPolar : {false, true}) {
            map.plane()->display().setPolar(isPolar);
            map.setMarks({});
            const QImage without = map.grab().toImage();
            map.setMarks(marks);
            const QImage with = map.grab().toImage();
            QVERIFY(with != without);
            QVERIFY(with == map.grab().toImage()); // stable
            map.plane()->display().setLayer(PictureDisplay::TrackLayer, false);
            QVERIFY(map.grab().toImage() == without);
            map.plane()->display().setLayer(PictureDisplay::TrackLayer, true);
        }
    }
};

FAINTLINE_WINDOW_TEST(tst_PingMap)
#include "tst_PingMap.moc"
