#include "support/test.h"
#include "widgets/base/Viewport.h"

using namespace faintline;

/// What linked views look at.
class tst_Viewport : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_view.setExtents({0.0, 100.0}, {1000.0, 2000.0}, 0.5, 5.0); }

    void startsWithAll()
    {
        QVERIFY(m_view.showsAll());
        QVERIFY(!m_view.cursor());
        QVERIFY(!m_view.canZoomBack());
        QCOMPARE(m_view.time().high, 100.0);
    }

    void zoomKeepsThePointInPlace()
    {
        m_view.zoomAt(2.0, {25.0, 1500.0});
        QCOMPARE(m_view.time().low, 12.5);
        QCOMPARE(m_view.time().high, 62.5);
        QCOMPARE(m_view.frequency().low, 1250.0);
        QCOMPARE(m_view.frequency().high, 1750.0);
        m_view.zoomAt(2.0, {25.0, 1500.0}, Viewport::Axes::Time);
        QCOMPARE(m_view.time().width(), 25.0);
        QCOMPARE(m_view.frequency().width(), 500.0);
    }

    void everythingStaysInside()
    {
        m_view.zoomTo({-50.0, 20.0}, {1900.0, 2300.0});
        QCOMPARE(m_view.time().low, 0.0);
        QCOMPARE(m_view.time().high, 70.0);
        QCOMPARE(m_view.frequency().high, 2000.0);
        m_view.pan(1000.0, -5000.0);
        QCOMPARE(m_view.time().high, 100.0);
        QCOMPARE(m_view.time().width(), 70.0);
        QCOMPARE(m_view.frequency().low, 1000.0);
        m_view.zoomAt(0.001, {50.0, 1500.0});
        QVERIFY(m_view.showsAll());
    }

    void roundingKeepsTheStartInside()
    {
        const Span full{0.1, 0.1 + 0.7};
        QVERIFY(full.high - full.width() < full.low); // what makes the case one
        const Span all = Span{-3.0, 5.0}.within(full);
        QCOMPARE(all.low, full.low);
        QCOMPARE(all.width(), full.width());
    }

    void zoomsInToTheSmallest()
    {
        m_view.zoomAt(1e9, {50.0, 1500.0});
        QCOMPARE(m_view.time().width(), 0.5);
        QCOMPARE(m_view.frequency().width(), 5.0);
        QVERIFY(m_view.time().contains(50.0));
    }

    void backspaceGoesBack()
    {
        m_view.zoomTo({10.0, 20.0}, {1100.0, 1200.0});
        m_view.zoomTo({12.0, 14.0}, {1110.0, 1120.0});
        m_view.zoomBack();
        QCOMPARE(m_view.time().low, 10.0);
        m_view.zoomBack();
        QVERIFY(m_view.showsAll());
        m_view.zoomBack();
        QVERIFY(m_view.showsAll());
    }

    void aRunOfWheelNotchesIsOneStep()
    {
        for (int notch = 0; notch < 5; ++notch)
            m_view.zoomAt(1.25, {50.0, 1500.0});
        m_view.zoomBack();
        QVERIFY(m_view.showsAll());
        QVERIFY(!m_view.canZoomBack());
    }

    void revealMovesNoFurtherThanNeeded()
    {
        m_view.zoomTo({10.0, 30.0}, {1100.0, 1300.0});
        m_view.reveal({{15.0, 18.0}, {1150.0, 1160.0}});
        QCOMPARE(m_view.time().low, 10.0);
        m_view.reveal({{40.0, 42.0}, {1150.0, 1160.0}});
        QVERIFY(m_view.time().contains(40.0) && m_view.time().contains(42.0));
        QCOMPARE(m_view.time().width(), 20.0);
        QCOMPARE(m_view.frequency().low, 1100.0);
        m_view.reveal({{20.0, 90.0}, {1150.0, 1160.0}});
        QVERIFY(m_view.time().contains(20.0) && m_view.time().contains(90.0));
    }

    void cursorIsClamped()
    {
        m_view.setCursor({-5.0, 9999.0});
        QCOMPARE(m_view.cursor()->seconds, 0.0);
        QCOMPARE(m_view.cursor()->hz, 2000.0);
        m_view.setExtents({0.0, 10.0}, {0.0, 1.0});
        QVERIFY(!m_view.cursor());
    }

    void signalsOnlyChanges()
    {
        QSignalSpy spans(&m_view, &Viewport::spanChanged), cursors(&m_view, &Viewport::cursorChanged);
        m_view.showAll();
        m_view.pan(-10.0, 0.0);
        QCOMPARE(spans.count(), 0);
        m_view.zoomTo({0.0, 50.0}, {1000.0, 2000.0});
        QCOMPARE(spans.count(), 1);
        m_view.setCursor({5.0, 1500.0});
        m_view.setCursor({5.0, 1500.0});
        QCOMPARE(cursors.count(), 1);
    }

    void emptyIsHarmless()
    {
        Viewport view;
        QVERIFY(view.isEmpty());
        view.zoomAt(2.0, {0.0, 0.0});
        view.pan(1.0, 1.0);
        view.setCursor({1.0, 1.0});
        view.showAll();
        view.zoomBack();
        QVERIFY(!view.cursor());
    }

    // As a waterfall of what is heard: it runs along with the end, until one looks elsewhere.
    void followsWhatGrows()
    {
        m_view.zoomTo({60.0, 100.0}, {1200.0, 1500.0});
        QSignalSpy following(&m_view, &Viewport::followingChanged);
        m_view.setFollowing(true);
        m_view.grow({0.0, 110.0});
        QCOMPARE(m_view.time(), (Span{70.0, 110.0}));
        QCOMPARE(m_view.frequency(), (Span{1200.0, 1500.0}));
        m_view.pan(-5.0, 0.0);
        QVERIFY(!m_view.isFollowing());
        m_view.grow({0.0, 120.0});
        QCOMPARE(m_view.time(), (Span{65.0, 105.0}));
        m_view.pan(1000.0, 0.0); // to the end
        QVERIFY(m_view.isFollowing());
        m_view.grow({0.0, 125.0});
        QCOMPARE(m_view.time(), (Span{85.0, 125.0}));
        m_view.setFollowing(false); // held
        m_view.grow({0.0, 130.0});
        QCOMPARE(m_view.time(), (Span{85.0, 125.0}));
        m_view.setFollowing(true);
        QCOMPARE(m_view.time(), (Span{90.0, 130.0}));
        QCOMPARE(following.count(), 5);
        m_view.setExtents({0.0, 10.0}, {0.0, 1.0}); // something else, which does not grow
        QVERIFY(!m_view.isFollowing());
        m_view.showAll();
        QVERIFY(!m_view.isFollowing());
    }

    void logarithmicZoomAndScrollKeepRatios()
    {
        m_view.setExtents({0.0, 10.0}, {10.0, 10000.0}, 0.5, 1.0);
        QSignalSpy scale(&m_view, &Viewport::scaleChanged);
        m_view.setLogarithmic(true);
        QCOMPARE(scale.count(), 1);
        QVERIFY(m_view.isLogarithmic() && m_view.showsAll());
        m_view.zoomAt(3.0, {5.0, 100.0},
                      Viewport::Axes::Frequency); // three decades become one; 100 Hz stays at a third
        QVERIFY(std::abs(m_view.frequency().high / m_view.frequency().low - 10.0) < 1e-9);
        QVERIFY(std::abs(std::log10(100.0 / m_view.frequency().low) - 1.0 / 3.0) < 1e-9);
        const Viewport::Box before = m_view.visible();
        m_view.scroll(0.0, 0.5);
        QVERIFY(std::abs(m_view.frequency().low / before.frequency.low - std::sqrt(10.0)) < 1e-9);
        QVERIFY(std::abs(m_view.frequency().high / before.frequency.high - std::sqrt(10.0)) < 1e-9);
        m_view.move(before, {0.0, 200.0}, {0.0, 100.0}); // what was at 200 Hz comes to where 100 Hz was
        QVERIFY(std::abs(m_view.frequency().low / before.frequency.low - 2.0) < 1e-9);
        m_view.reveal({{1.0, 2.0}, {5000.0, 6000.0}});
        QVERIFY(m_view.frequency().contains(5000.0) && m_view.frequency().contains(6000.0));
        m_view.showAll();
        QVERIFY(m_view.showsAll());
        m_view.setLogarithmic(false);
        QCOMPARE(m_view.frequency().low, 10.0);
    }

    void logarithmicExtentsBeginAboveZero()
    {
        m_view.setExtents({0.0, 10.0}, {-0.5, 8000.5}, 0.5, 8.0); // cells of 1 Hz from 0 Hz on
        m_view.setLogarithmic(true);
        QCOMPARE(m_view.full().frequency.low, 8.0005); // a thousandth of the highest
        QCOMPARE(m_view.extents().frequency.low, -0.5);
        m_view.zoomTo({0.0, 10.0}, {-100.0, 16.0});
        QCOMPARE(m_view.frequency().low, 8.0005);
        m_view.setExtents({0.0, 10.0}, {-0.5, 64.5}, 0.5, 8.0); // it holds for later recordings
        QVERIFY(m_view.isLogarithmic());
        QCOMPARE(m_view.full().frequency.low, 0.5); // above the cell of 0 Hz
    }

    void negativeFrequenciesStayLinear()
    {
        m_view.setLogarithmic(true);
        QSignalSpy scale(&m_view, &Viewport::scaleChanged);
        m_view.setExtents({0.0, 10.0}, {-500.0, 500.0});
        QVERIFY(!m_view.isLogarithmic() && !m_view.canBeLogarithmic());
        QCOMPARE(scale.count(), 1);
        m_view.setLogarithmic(false); // means nothing here
        m_view.setExtents({0.0, 10.0}, {0.0, 500.0});
        QVERIFY(m_view.isLogarithmic());
    }

private:
    Viewport m_view;
};

FAINTLINE_WINDOW_TEST(tst_Viewport)
#include "tst_Viewport.moc"
