#include "support/test.h"
#include "widgets/waterfall/ColourBar.h"

#include "pictures.h"
#include "widgets/base/Theme.h"

using namespace faintline;

/// The legend that is also the handle.
class tst_ColourBar : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void init()
    {
        m_asked.clear();
        m_bar = std::make_unique<ColourBar>();
        m_bar->resize(78, 300);
        m_bar->setRange(-6.0, 14.0);
        connect(m_bar.get(), &ColourBar::rangeRequested, this, [this](double low, double high) {
            m_asked.push_back({low, high});
            m_bar->setRange(low, high);
        });
    }

    void endsAreDragged()
    {
        drag(14.0, 9.0);
        QVERIFY(std::abs(m_bar->range().high - 9.0) < 0.2);
        QCOMPARE(m_bar->range().low, -6.0);
        drag(-6.0, 0.0);
        QVERIFY(std::abs(m_bar->range().low - 0.0) < 0.2);
    }

    void middleMovesBoth()
    {
        drag(4.0, 6.0);
        QVERIFY(std::abs(m_bar->range().low + 4.0) < 0.2);
        QVERIFY(std::abs(m_bar->range().width() - 20.0) < 1e-9);
    }

    void endsNeverCross()
    {
        drag(14.0, -30.0);
        QVERIFY(m_bar->range().high > m_bar->range().low);
    }

    void endOfALongRangeIsDraggedOnItsOwnScale()
    {
        m_bar->setHistogram(ByteScale(ByteScale::Kind::ScoreNats), {});
        m_bar->setMarker(16.0);
        m_bar->setRange(0.0, 2000.0);
        const ColourScale scale = ColourScale::of(ByteScale(ByteScale::Kind::ScoreNats), 16.0);
        const Span places = scale.places(m_bar->range());
        const double half = scale.value(places.middle());
        drag(places.high, places.middle());
        QVERIFY(half < 300.0);
        QVERIFY(std::abs(m_bar->range().high / half - 1.0) < 0.05);
        QCOMPARE(m_bar->range().low, 0.0);
    }

    void doubleClickAsksForAutomatic()
    {
        QSignalSpy automatic(m_bar.get(), &ColourBar::automaticRequested);
        QTest::mouseDClick(m_bar.get(), Qt::LeftButton, {}, {30, 150});
        QCOMPARE(automatic.count(), 1);
        QVERIFY(m_asked.empty());
    }

    void keysMoveTheEnds()
    {
        QTest::keyClick(m_bar.get(), Qt::Key_Up);
        QVERIFY(m_bar->range().high > 14.0);
        QCOMPARE(m_bar->range().low, -6.0);
        QTest::keyClick(m_bar.get(), Qt::Key_Down, Qt::ShiftModifier);
        QVERIFY(m_bar->range().low < -6.0);
    }

    void attachedItSteersTheView()
    {
        WaterfallView view("Statistic");
        ColourBar bar;
        bar.attach(&view);
        view.resize(400, 300);
        view.setPicture(test::countingPicture(4, 30), test::hzAxis(30));
        view.grab();
        QCOMPARE(bar.range(), view.range());
        emit bar.rangeRequested(2.0, 9.0);
        QCOMPARE(view.range(), (Span{2.0, 9.0}));
        QCOMPARE(bar.range(), view.range());
        emit bar.automaticRequested();
        QVERIFY(view.isRangeAutomatic());
        QCOMPARE(bar.range(), view.range());
        view.display().setColourMap("viridis");
        bar.grab();
    }

private:
    void drag(double fromPlace, double toPlace)
    {
        // The bar shows the range and 6 % of it beyond either end where there is no histogram.
        const Span range = m_bar->places();
        const Span scale{range.low - 0.06 * range.width(), range.high + 0.06 * range.width()};
        const auto y = [&](double value) { return 288.0 - (value - scale.low) / scale.width() * (288.0 - 26.0); };
        const QPointF from(30.0, y(fromPlace)), to(30.0, y(toPlace));
        QTest::mousePress(m_bar.get(), Qt::LeftButton, {}, from.toPoint());
        QMouseEvent move(QEvent::MouseMove, to, m_bar->mapToGlobal(to), Qt::NoButton, Qt::LeftButton, {});
        QCoreApplication::sendEvent(m_bar.get(), &move);
        QTest::mouseRelease(m_bar.get(), Qt::LeftButton, {}, to.toPoint());
    }

    /// The bar asks; here it is granted.
    std::unique_ptr<ColourBar> m_bar;
    std::vector<Span> m_asked;
};

FAINTLINE_WINDOW_TEST(tst_ColourBar)
#include "tst_ColourBar.moc"
