#include "support/test.h"
#include "widgets/pings/PingViewports.h"

using namespace faintline;

/// One range, one bearing and one time in three viewports.
class tst_PingViewports : public QObject
{
    Q_OBJECT

private slots:
    void init()
    {
        m_pings.reset();
        m_alongTime = std::make_unique<Viewport>();
        m_pings = std::make_unique<PingViewports>(*m_alongTime);
        m_pings->setExtents({{0.0, 100.0}, 4.0}, {{{1000.0, 3000.0}, 40.0}, {{0.0, 360.0}, 10.0}});
    }

    void extentsShowAll()
    {
        QVERIFY(m_pings->map().showsAll() && m_pings->alongTime().showsAll() && m_pings->acrossTime().showsAll());
        QCOMPARE(m_pings->map().time(), (Span{1000.0, 3000.0}));
        QCOMPARE(m_pings->map().frequency(), (Span{0.0, 360.0}));
        QCOMPARE(m_pings->acrossTime().time(), (Span{0.0, 100.0}));
    }

    void zoomingOneZoomsTheOthers()
    {
        m_pings->map().zoomTo({1500.0, 2000.0}, {90.0, 180.0});
        QCOMPARE(m_pings->alongTime().frequency(), (Span{1500.0, 2000.0}));
        QCOMPARE(m_pings->acrossTime().frequency(), (Span{90.0, 180.0}));
        QCOMPARE(m_pings->alongTime().time(), (Span{0.0, 100.0}));

        m_pings->acrossTime().zoomTo({20.0, 60.0}, {100.0, 160.0});
        QCOMPARE(m_pings->alongTime().visible(), (Viewport::Box{{20.0, 60.0}, {1500.0, 2000.0}}));
        QCOMPARE(m_pings->map().visible(), (Viewport::Box{{1500.0, 2000.0}, {100.0, 160.0}}));

        m_pings->alongTime().zoomTo({30.0, 50.0}, {1600.0, 1700.0});
        QCOMPARE(m_pings->map().time(), (Span{1600.0, 1700.0}));
        QCOMPARE(m_pings->acrossTime().time(), (Span{30.0, 50.0}));
    }

    void theLeastSpansHoldEverywhere()
    {
        m_pings->map().zoomTo({2000.0, 2000.1}, {180.0, 180.1});
        QVERIFY(m_pings->map().time().width() >= 40.0);
        QVERIFY(m_pings->map().frequency().width() >= 10.0);
        QCOMPARE(m_pings->alongTime().frequency(), m_pings->map().time());
        QCOMPARE(m_pings->acrossTime().frequency(), m_pings->map().frequency());
    }

    void cursorsFollowThePlace()
    {
        m_pings->setPlace({40.0, {1234.0, 56.0}});
        QCOMPARE(*m_pings->alongTime().cursor(), (Viewport::Point{40.0, 1234.0}));
        QCOMPARE(*m_pings->map().cursor(), (Viewport::Point{1234.0, 56.0}));
        QCOMPARE(*m_pings->acrossTime().cursor(), (Viewport::Point{40.0, 56.0}));
    }

    void aClickInOneMovesThePlace_data()
    {
        QTest::addColumn<int>("view");
        QTest::addColumn<double>("seconds");
        QTest::addColumn<double>("range");
        QTest::addColumn<double>("bearing");
        QTest::newRow("map keeps the time") << 0 << 40.0 << 2000.0 << 270.0;
        QTest::newRow("range over time keeps the bearing") << 1 << 10.0 << 2000.0 << 56.0;
        QTest::newRow("bearing over time keeps the range") << 2 << 10.0 << 1234.0 << 270.0;
    }

    void aClickInOneMovesThePlace()
    {
        QFETCH(int, view);
        QFETCH(double, seconds);
        QFETCH(double, range);
        QFETCH(double, bearing);
        m_pings->setPlace({40.0, {1234.0, 56.0}});
        Viewport *const views[] = {&m_pings->map(), &m_pings->alongTime(), &m_pings->acrossTime()};
        const Viewport::Point clicks[] = {{2000.0, 270.0}, {10.0, 2000.0}, {10.0, 270.0}};
        views[view]->setCursor(clicks[view]);
        QCOMPARE(m_pings->place(), (PingViewports::Place{seconds, {range, bearing}}));
        QCOMPARE(*m_pings->map().cursor(), (Viewport::Point{range, bearing}));
        QCOMPARE(*m_pings->alongTime().cursor(), (Viewport::Point{seconds, range}));
        QCOMPARE(*m_pings->acrossTime().cursor(), (Viewport::Point{seconds, bearing}));
    }

    void thePlaceIsToldOncePerChange()
    {
        QSignalSpy changed(m_pings.get(), &PingViewports::placeChanged);
        m_pings->setPlace({40.0, {1234.0, 56.0}});
        QCOMPARE(changed.size(), 1);
        m_pings->setPlace({40.0, {1234.0, 56.0}});
        QCOMPARE(changed.size(), 1);
        m_pings->map().setCursor({1234.0, 57.0});
        QCOMPARE(changed.size(), 2);
    }

    void nothingOpenNothingFollows()
    {
        m_pings->map().zoomTo({1500.0, 2000.0}, {90.0, 180.0});
        m_alongTime->setExtents({}, {}); // something else is being opened
        QCOMPARE(m_pings->map().visible(), (Viewport::Box{{1500.0, 2000.0}, {90.0, 180.0}}));
    }

    /// Four axes, of which two are shown: the place is on all of them, whatever is shown.
    void otherAxesOfTheSamePlace()
    {
        const std::vector<PingViewports::Extent> axes{
            {{1000.0, 3000.0}, 40.0}, {{0.0, 360.0}, 10.0}, {{0.0, 20.0}, 2.0}, {{-70.0, 70.0}, 20.0}};
        m_pings->setExtents({{0.0, 100.0}, 4.0}, axes);
        m_pings->setPlace({40.0, {1234.0, 56.0, 8.0, -30.0}});
        m_pings->acrossTime().zoomTo({20.0, 60.0}, {0.0, 180.0});
        QSignalSpy changed(m_pings.get(), &PingViewports::planeChanged);
        m_pings->setPlane({3, 2, {}});
        QCOMPARE(changed.size(), 1);
        QCOMPARE(m_pings->map().visible(), (Viewport::Box{{-70.0, 70.0}, {0.0, 20.0}}));
        QCOMPARE(m_pings->alongTime().visible(), (Viewport::Box{{20.0, 60.0}, {-70.0, 70.0}})); // the time remains
        QCOMPARE(m_pings->acrossTime().visible(), (Viewport::Box{{20.0, 60.0}, {0.0, 20.0}}));
        QCOMPARE(*m_pings->map().cursor(), (Viewport::Point{-30.0, 8.0}));
        QCOMPARE(*m_pings->alongTime().cursor(), (Viewport::Point{40.0, -30.0}));
        QSignalSpy moved(m_pings.get(), &PingViewports::cursorMoved);
        m_pings->map().setCursor({10.0, 12.0});
        QCOMPARE(moved.size(), 1);
        QCOMPARE(m_pings->place(), (PingViewports::Place{40.0, {1234.0, 56.0, 12.0, 10.0}}));
        m_pings->setPlace({50.0, {1300.0, 50.0, 2.0, 0.0}});
        QCOMPARE(moved.size(), 1); // by a view only
        // Cuts leave the axes as they are.
        m_pings->map().zoomTo({-30.0, 30.0}, {4.0, 16.0});
        m_pings->setPlane({3, 2, {4, 5}});
        QCOMPARE(m_pings->map().visible(), (Viewport::Box{{-30.0, 30.0}, {4.0, 16.0}}));
        // Another source begins on its first two axes.
        m_pings->setExtents({{0.0, 50.0}, 4.0}, {axes[0], axes[1]});
        QCOMPARE(m_pings->plane(), FramePlane());
        QCOMPARE(m_pings->map().time(), axes[0].whole);
    }

private:
    std::unique_ptr<Viewport> m_alongTime;
    std::unique_ptr<PingViewports> m_pings;
};

FAINTLINE_WINDOW_TEST(tst_PingViewports)
#include "tst_PingViewports.moc"
