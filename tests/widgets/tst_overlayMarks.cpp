#include "support/test.h"
#include "widgets/waterfall/overlayMarks.h"

#include "pictures.h"
#include "widgets/waterfall/Sidebands.h"
#include "widgets/waterfall/peakNear.h"

using namespace faintline;

/// What lies over a waterfall, in seconds and Hz, and the peak and lines one points at.
class tst_overlayMarks : public QObject
{
    Q_OBJECT

private slots:
    void tracksGoThroughTheirCells()
    {
        const auto lines = overlayLines({track(7, 3, {10, 11, 11})}, m_time, m_frequency);
        QCOMPARE(lines.size(), std::size_t(1));
        QCOMPARE(lines[0].id, 7);
        QCOMPARE(lines[0].points, (QPolygonF{{3.5, 120.0}, {4.5, 122.0}, {5.5, 122.0}}));
        QVERIFY(lines[0].band.isEmpty());
    }

    void smoothedTracksLieBetweenCells()
    {
        Track followed = track(1, 0, {10, 11});
        followed.smoothed = {{10.25, 9.5f, 11.0f, 1.0f, 1.0f}, {10.75, 10.0f, 11.5f, 1.0f, 1.0f}};
        const auto lines = overlayLines({followed}, m_time, m_frequency);
        QCOMPARE(lines[0].points, (QPolygonF{{0.5, 120.5}, {1.5, 121.5}}));
        // Forth along the low side and back along the high one.
        QCOMPARE(lines[0].band, (QPolygonF{{0.5, 119.0}, {1.5, 120.0}, {1.5, 123.0}, {0.5, 122.0}}));
    }

    void tracksHaveGapsWhereTheyPause()
    {
        Track keyed = track(3, 0, {10, 10, 20, 30, 12});
        for (const float presence : {1.0f, 0.9f, 0.1f, 0.0f, 0.8f}) {
            const auto position = double(keyed.points[keyed.smoothed.size()].cell);
            keyed.smoothed.push_back({position, float(position - 1.0), float(position + 1.0), presence, 1.0f});
        }
        const auto lines = overlayLines({keyed}, m_time, m_frequency);
        QCOMPARE(lines.size(), std::size_t(2));
        QCOMPARE(lines[0].points, (QPolygonF{{0.5, 120.0}, {1.5, 120.0}}));
        QCOMPARE(lines[1].points, (QPolygonF{{4.0, 124.0}, {5.0, 124.0}}));
        QCOMPARE(lines[0].band, (QPolygonF{{0.5, 118.0}, {1.5, 118.0}, {1.5, 122.0}, {0.5, 122.0}}));
        QCOMPARE(lines[1].id, 3);
        const auto marks = overlayMarks({test::event(3, 0.5, 4.5, 120.0)}, lines, 1.0, 2.0);
        QCOMPARE(marks.size(), std::size_t(1));
        QCOMPARE(marks[0].box.time, (Span{0.0, 5.0}));
        QCOMPARE(marks[0].box.frequency, (Span{119.0, 125.0})); // of both stretches, not of the pause
    }

    void truthEndsWhereItsLineDoes_data()
    {
        QTest::addColumn<double>("end");
        QTest::addColumn<int>("points");
        QTest::newRow("at its last value") << 4.0 << 3;
        QTest::newRow("before it") << 3.5 << 3;
        QTest::newRow("after it") << 4.5 << 4;
    }

    void truthEndsWhereItsLineDoes()
    {
        QFETCH(double, end);
        QFETCH(int, points);
        TruthLine line;
        line.startSeconds = 2.0;
        line.endSeconds = end;
        line.stepSeconds = 1.0;
        line.frequencyHz = {120.0, 121.0, 122.0};
        const auto drawn = overlayLines(std::vector{line, TruthLine()});
        QCOMPARE(drawn.size(), std::size_t(1)); // one without a frequency is nowhere
        QCOMPARE(drawn[0].points.size(), qsizetype(points));
        QCOMPARE(drawn[0].points.front(), QPointF(2.0, 120.0));
        QCOMPARE(drawn[0].points.back(), QPointF(end, 122.0));
    }

    void aMarkHoldsItsTrack()
    {
        const auto lines = overlayLines({track(3, 2, {10, 14, 9})}, m_time, m_frequency);
        const auto marks = overlayMarks({test::event(3, 2.5, 4.5, 120.0)}, lines, 1.0, 2.0);
        QCOMPARE(marks.size(), std::size_t(1));
        QCOMPARE(marks[0].box.frequency, (Span{117.0, 129.0})); // half a bin around 118 … 128 Hz
        QCOMPARE(marks[0].box.time, (Span{2.0, 5.0}));
    }

    void aMarkWithoutTrackHoldsItsStraightLine()
    {
        Event event = test::event(3, 2.0, 6.0, 120.0); // detected in the middle
        event.driftPerSecond = 3.0;
        event.isConfirmed = false;
        const auto marks = overlayMarks({event}, {}, 1.0, 2.0);
        QCOMPARE(marks[0].box.frequency, (Span{113.0, 127.0}));
        QVERIFY(!marks[0].isConfirmed);
        event.position.clear();
        QVERIFY(overlayMarks({event}, {}, 1.0, 2.0).empty()); // of no place
    }

    void aMarkIsNeverThinnerThanACell()
    {
        const auto marks = overlayMarks({test::event(1, 5.0, 5.0, 130.0)}, {}, 1.0, 2.0);
        QCOMPARE(marks[0].box, (Viewport::Box{{4.5, 5.5}, {129.0, 131.0}}));
    }

    void areasAreBoxes()
    {
        const auto boxes = overlayBoxes({{2.0, 3.0, 110.0, 140.0, 4.0}});
        QCOMPARE(boxes.size(), std::size_t(1));
        QCOMPARE(boxes[0].box, (Viewport::Box{{2.0, 3.0}, {110.0, 140.0}}));
        QVERIFY(!boxes[0].text.isEmpty() && !boxes[0].isFaint);
    }

    void thePeakIsTheStrongestInTheBox()
    {
        // The strongest cell of all lies outside.
        const auto picture = test::picture(20, 50, [](Index frame, Index cell) {
            return frame == 5 && cell == 40 ? 30.0f : frame == 4 && cell == 12 ? 20.0f : 1.0f;
        });
        const auto peak = peakNear(*picture, m_frequency, {{3.0, 8.0}, {110.0, 140.0}});
        QVERIFY(peak);
        QCOMPARE(*peak, (Viewport::Point{4.5, 124.0}));
        QCOMPARE(*peakNear(*picture, m_frequency, {{3.0, 8.0}, {110.0, 190.0}}), (Viewport::Point{5.5, 180.0}));
    }

    void anEmptyBoxHasNoPeak()
    {
        const auto picture = test::countingPicture(20, 50);
        QVERIFY(!peakNear(*picture, m_frequency, {{0.6, 1.4}, {100.0, 110.0}})); // between the middles of two frames
        QVERIFY(!peakNear(*picture, m_frequency, {{0.0, 5.0}, {100.2, 101.8}}));
        QVERIFY(!peakNear(*picture, m_frequency, {{0.0, 5.0}, {300.0, 400.0}}));
    }

    void ofEqualPeaksTheFirst()
    {
        const auto picture = test::picture(20, 50, [](Index, Index) { return 5.0f; });
        QCOMPARE(*peakNear(*picture, m_frequency, {{3.0, 8.0}, {110.0, 140.0}}), (Viewport::Point{3.5, 110.0}));
    }

    void sidebandsKnowTheirOrder_data()
    {
        QTest::addColumn<double>("hz");
        QTest::addColumn<int>("order");
        QTest::newRow("carrier") << 1001.0 << 0;
        QTest::newRow("first above") << 1012.0 << 1;
        QTest::newRow("second below") << 979.0 << -2;
        QTest::newRow("beyond the last") << 1200.0 << 5;
        QTest::newRow("beyond the first") << 800.0 << -5;
    }

    void sidebandsKnowTheirOrder()
    {
        QFETCH(double, hz);
        QFETCH(int, order);
        const Sidebands lines{1000.0, 10.0};
        QCOMPARE(lines.nearestOrder(hz), order);
        if (order != 0) {
            const Sidebands moved{1000.0, lines.spacingFor(order, hz)};
            QVERIFY(std::abs(moved.hz(order) - hz) < 1e-9); // its line is where it was taken to
        }
        QCOMPARE((Sidebands{1000.0, 0.0}.nearestOrder(hz)), 0);
    }

private:
    const Axis m_time = test::timeAxis(20);    // 0.5, 1.5 … s
    const Axis m_frequency = test::hzAxis(50); // 100, 102 … Hz

    static Track track(int id, Index first, const std::vector<Index> &cells)
    {
        Track result;
        result.id = id;
        for (std::size_t i = 0; i < cells.size(); ++i)
            result.points.push_back({first + Index(i), cells[i], 0, 10.0});
        return result;
    }
};

FAINTLINE_WINDOW_TEST(tst_overlayMarks)
#include "tst_overlayMarks.moc"
