#include "support/test.h"
#include "widgets/plot/StripPlot.h"
#include "widgets/waterfall/OverviewStrip.h"

#include "pictures.h"
#include "pixels.h"
#include "widgets/base/Theme.h"

#include <qwt_plot_curve.h>
#include <qwt_text.h>

#include <cmath>

using namespace faintline;

/// What runs along time: curves and the overview.
class tst_strips : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }
    void init() { m_viewport.setExtents({0.0, 1000.0}, {99.0, 119.0}, 1.0, 2.0); }

    void aPeakOfOneFrameIsDrawn()
    {
        StripPlot plot("D (nat)");
        plot.setViewport(&m_viewport);
        std::vector<float> values(100000, 1.0f);
        values[54321] = 42.0f;
        plot.setSeries("D", test::timeAxis(100000, 0.01), values);
        test::show(plot, {400, 120});
        const QwtPlotCurve *drawn = curve(plot, "D");
        QVERIFY(drawn);
        QVERIFY(drawn->dataSize() < 2000);
        QCOMPARE(drawn->maxYValue(), 42.0);
    }

    void gapsAreLeftOut()
    {
        StripPlot plot("D (nat)");
        plot.setViewport(&m_viewport);
        plot.setSeries("D", test::timeAxis(4, 250.0), {1.0f, std::nanf(""), 3.0f, std::nanf("")});
        test::show(plot, {400, 120});
        QCOMPARE(curve(plot, "D")->dataSize(), std::size_t(2));
    }

    void titlesFitLowStrips()
    {
        StripPlot plot(QString::fromUtf8("D (× noise)"));
        plot.setViewport(&m_viewport);
        plot.setSeries("D", test::timeAxis(4, 250.0), {1.0f, 2.0f, 3.0f, 4.0f});
        plot.setMinimumSize(1, 1);
        for (const int height : {240, 100, 240}) {
            test::show(plot, {400, height});
            const QwtText title = plot.axisTitle(QwtAxis::YLeft);
            const int length = QFontMetrics(title.font()).horizontalAdvance(title.text());
            QVERIFY2(length <= plot.canvas()->height(),
                     qPrintable(QString("%1 %2").arg(length).arg(plot.canvas()->height())));
            QCOMPARE(title.font() == Theme::plotTitleFont(), height == 240); // where there is room, as everywhere
        }
    }

    void profileFollowsTheCursor()
    {
        StripPlot plot("D (nat)");
        plot.setViewport(&m_viewport);
        plot.setProfile("at the cursor", test::countingPicture(4, 10), test::hzAxis(10));
        test::show(plot, {400, 120});
        QVERIFY(!curve(plot, "at the cursor"));
        m_viewport.setCursor({1.0, 106.3}); // cell 3
        QVERIFY(curve(plot, "at the cursor"));
        QCOMPARE(curve(plot, "at the cursor")->sample(2), QPointF(2.5, 23.0));
        m_viewport.setCursor({1.0, 100.0});
        QCOMPARE(curve(plot, "at the cursor")->sample(2), QPointF(2.5, 20.0));
        m_viewport.clearCursor();
        QVERIFY(!curve(plot, "at the cursor"));
    }

    void stripScrollsZoomsAndPlacesTheCursor()
    {
        StripPlot plot("D (nat)");
        plot.setViewport(&m_viewport);
        plot.setSeries("D", test::timeAxis(1000), std::vector<float>(1000, 1.0f));
        test::show(plot, {500, 140});
        m_viewport.zoomTo({200.0, 400.0}, {99.0, 119.0});
        const auto position = [&](double seconds) { return QPointF(plot.transform(QwtAxis::XBottom, seconds), 20.0); };
        QTest::mouseClick(plot.canvas(), Qt::LeftButton, {}, position(250.0).toPoint());
        QVERIFY(m_viewport.cursor() && std::abs(m_viewport.cursor()->seconds - 250.0) < 1.0);
        const QPointF from = position(300.0), to = position(350.0);
        drag(plot.canvas(), from, to);
        QVERIFY(std::abs(m_viewport.time().low - 150.0) < 2.0);
        const QPointF centre = plot.canvas()->geometry().center();
        QWheelEvent wheel(centre, plot.mapToGlobal(centre), {}, {0, 120}, Qt::NoButton, Qt::ControlModifier,
                          Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(&plot, &wheel);
        QVERIFY(std::abs(m_viewport.time().width() - 160.0) < 1e-6);
        QCOMPARE(m_viewport.frequency().width(), 20.0);
    }

    void overviewBoxIsDragged()
    {
        OverviewStrip strip;
        strip.setViewport(&m_viewport);
        strip.setPicture(test::countingPicture(4, 10), test::hzAxis(10));
        m_viewport.zoomTo({100.0, 300.0}, {103.0, 113.0});
        test::show(strip, {1016, 60}); // one pixel a second, from x = 8 on
        drag(&strip, {208.0, 20.0}, {408.0, 20.0});
        QVERIFY(std::abs(m_viewport.time().low - 300.0) < 1.0);
        QCOMPARE(m_viewport.time().width(), 200.0);
        QCOMPARE(m_viewport.frequency().low, 103.0);
    }

    void overviewSidesZoom()
    {
        OverviewStrip strip;
        strip.setViewport(&m_viewport);
        strip.setPicture(test::countingPicture(4, 10), test::hzAxis(10));
        m_viewport.zoomTo({100.0, 300.0}, {99.0, 119.0});
        test::show(strip, {1016, 60});
        drag(&strip, {308.0, 20.0}, {508.0, 20.0});
        QVERIFY(std::abs(m_viewport.time().low - 100.0) < 1.0);
        QVERIFY(std::abs(m_viewport.time().high - 500.0) < 1.0);
        QTest::mouseDClick(&strip, Qt::LeftButton, {}, {300, 20});
        QVERIFY(m_viewport.showsAll());
    }

    void overviewClickGoesThere()
    {
        OverviewStrip strip;
        strip.setViewport(&m_viewport);
        strip.setPicture(test::countingPicture(4, 10), test::hzAxis(10));
        m_viewport.zoomTo({100.0, 300.0}, {99.0, 119.0});
        test::show(strip, {1016, 60});
        QTest::mouseClick(&strip, Qt::LeftButton, {}, {808, 20});
        QVERIFY(std::abs(m_viewport.time().middle() - 800.0) < 1.0);
        QTest::keyClick(&strip, Qt::Key_Left);
        QVERIFY(std::abs(m_viewport.time().middle() - 780.0) < 1.0);
    }

    void overviewEmptyIsASentence()
    {
        OverviewStrip strip;
        strip.resize(400, 56);
        const QImage image = strip.grab().toImage();
        QVERIFY(test::coloursOf(image.copy(0, 22, image.width(), 1)).size() > 3);
        QTest::mouseClick(&strip, Qt::LeftButton);
        QTest::keyClick(&strip, Qt::Key_Right);
    }

private:
    static QwtPlotCurve *curve(StripPlot &plot, const QString &name)
    {
        for (QwtPlotItem *item : plot.itemList(QwtPlotItem::Rtti_PlotCurve))
            if (item->title().text() == name)
                return static_cast<QwtPlotCurve *>(item);
        return nullptr;
    }
    void drag(QWidget *widget, const QPointF &from, const QPointF &to)
    {
        QTest::mousePress(widget, Qt::LeftButton, {}, from.toPoint());
        QMouseEvent move(QEvent::MouseMove, to, widget->mapToGlobal(to), Qt::NoButton, Qt::LeftButton, {});
        QCoreApplication::sendEvent(widget, &move);
        QTest::mouseRelease(widget, Qt::LeftButton, {}, to.toPoint());
    }

    Viewport m_viewport;
};

FAINTLINE_WINDOW_TEST(tst_strips)
#include "tst_strips.moc"
