#include "widgets/pings/PingViewports.h"

#include <QtTest>

using namespace faintline;

/// One range, one bearing and one time in three viewports.
class tst_PingViewports : public QObject
{
    Q_OBJECT

private slots:
    void init();
    void extentsShowAll();
    void zoomingOneZoomsTheOthers();
    void theLeastSpansHoldEverywhere();
    void cursorsFollowThePlace();
    void aClickInOneMovesThePlace_data();
    void aClickInOneMovesThePlace();
    void thePlaceIsToldOncePerChange();
    void nothingOpenNothingFollows();

private:
    std::unique_ptr<Viewport> m_rangeTime;
    std::unique_ptr<PingViewports> m_pings;
};

void tst_PingViewports::init()
{
    m_pings.reset();
    m_rangeTime = std::make_unique<Viewport>();
    m_pings = std::make_unique<PingViewports>(*m_rangeTime);
    m_pings->setExtents({0.0, 100.0}, {1000.0, 3000.0}, {0.0, 360.0}, {4.0, 40.0, 10.0});
}

void tst_PingViewports::extentsShowAll()
{
    QVERIFY(m_pings->map().showsAll() && m_pings->rangeTime().showsAll() && m_pings->bearingTime().showsAll());
    QCOMPARE(m_pings->map().time(), (Span{1000.0, 3000.0}));
    QCOMPARE(m_pings->map().frequency(), (Span{0.0, 360.0}));
    QCOMPARE(m_pings->bearingTime().time(), (Span{0.0, 100.0}));
}

void tst_PingViewports::zoomingOneZoomsTheOthers()
{
    m_pings->map().zoomTo({1500.0, 2000.0}, {90.0, 180.0});
    QCOMPARE(m_pings->rangeTime().frequency(), (Span{1500.0, 2000.0}));
    QCOMPARE(m_pings->bearingTime().frequency(), (Span{90.0, 180.0}));
    QCOMPARE(m_pings->rangeTime().time(), (Span{0.0, 100.0}));

    m_pings->bearingTime().zoomTo({20.0, 60.0}, {100.0, 160.0});
    QCOMPARE(m_pings->rangeTime().visible(), (Viewport::Box{{20.0, 60.0}, {1500.0, 2000.0}}));
    QCOMPARE(m_pings->map().visible(), (Viewport::Box{{1500.0, 2000.0}, {100.0, 160.0}}));

    m_pings->rangeTime().zoomTo({30.0, 50.0}, {1600.0, 1700.0});
    QCOMPARE(m_pings->map().time(), (Span{1600.0, 1700.0}));
    QCOMPARE(m_pings->bearingTime().time(), (Span{30.0, 50.0}));
}

void tst_PingViewports::theLeastSpansHoldEverywhere()
{
    m_pings->map().zoomTo({2000.0, 2000.1}, {180.0, 180.1});
    QVERIFY(m_pings->map().time().width() >= 40.0);
    QVERIFY(m_pings->map().frequency().width() >= 10.0);
    QCOMPARE(m_pings->rangeTime().frequency(), m_pings->map().time());
    QCOMPARE(m_pings->bearingTime().frequency(), m_pings->map().frequency());
}

void tst_PingViewports::cursorsFollowThePlace()
{
    m_pings->setPlace({40.0, 1234.0, 56.0});
    QCOMPARE(*m_pings->rangeTime().cursor(), (Viewport::Point{40.0, 1234.0}));
    QCOMPARE(*m_pings->map().cursor(), (Viewport::Point{1234.0, 56.0}));
    QCOMPARE(*m_pings->bearingTime().cursor(), (Viewport::Point{40.0, 56.0}));
}

void tst_PingViewports::aClickInOneMovesThePlace_data()
{
    QTest::addColumn<int>("view");
    QTest::addColumn<double>("seconds");
    QTest::addColumn<double>("range");
    QTest::addColumn<double>("bearing");
    QTest::newRow("map keeps the time") << 0 << 40.0 << 2000.0 << 270.0;
    QTest::newRow("range over time keeps the bearing") << 1 << 10.0 << 2000.0 << 56.0;
    QTest::newRow("bearing over time keeps the range") << 2 << 10.0 << 1234.0 << 270.0;
}

void tst_PingViewports::aClickInOneMovesThePlace()
{
    QFETCH(int, view);
    QFETCH(double, seconds);
    QFETCH(double, range);
    QFETCH(double, bearing);
    m_pings->setPlace({40.0, 1234.0, 56.0});
    Viewport *const views[] = {&m_pings->map(), &m_pings->rangeTime(), &m_pings->bearingTime()};
    const Viewport::Point clicks[] = {{2000.0, 270.0}, {10.0, 2000.0}, {10.0, 270.0}};
    views[view]->setCursor(clicks[view]);
    QCOMPARE(m_pings->place(), (PingViewports::Place{seconds, range, bearing}));
    QCOMPARE(*m_pings->map().cursor(), (Viewport::Point{range, bearing}));
    QCOMPARE(*m_pings->rangeTime().cursor(), (Viewport::Point{seconds, range}));
    QCOMPARE(*m_pings->bearingTime().cursor(), (Viewport::Point{seconds, bearing}));
}

void tst_PingViewports::thePlaceIsToldOncePerChange()
{
    QSignalSpy changed(m_pings.get(), &PingViewports::placeChanged);
    m_pings->setPlace({40.0, 1234.0, 56.0});
    QCOMPARE(changed.size(), 1);
    m_pings->setPlace({40.0, 1234.0, 56.0});
    QCOMPARE(changed.size(), 1);
    m_pings->map().setCursor({1234.0, 57.0});
    QCOMPARE(changed.size(), 2);
}

void tst_PingViewports::nothingOpenNothingFollows()
{
    m_pings->map().zoomTo({1500.0, 2000.0}, {90.0, 180.0});
    m_rangeTime->setExtents({}, {}); // something else is being opened
    QCOMPARE(m_pings->map().visible(), (Viewport::Box{{1500.0, 2000.0}, {90.0, 180.0}}));
}

QTEST_MAIN(tst_PingViewports)
#include "tst_PingViewports.moc"
