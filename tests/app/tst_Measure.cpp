// Measuring in the window with keys and mouse: a box's area SNR, sidebands in both pictures, the peak.

#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "support/find.h"
#include "support/test.h"
#include "widgets/waterfall/OverlayItem.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QAction>
#include <QMenu>
#include <QMenuBar>

#include <memory>

using namespace faintline;
using namespace faintline::test;

static QString boxText(const WaterfallView &view)
{
    return itemOf<OverlayItem>(view).selectionText;
}

class tst_Measure : public WindowTest
{
    Q_OBJECT

    static void drag(WaterfallView &view, const Viewport::Point &from, const Viewport::Point &to)
    {
        QWidget *canvas = view.canvas();
        const QPoint start = view.positionOf(from).toPoint(), end = view.positionOf(to).toPoint();
        QTest::mousePress(canvas, Qt::LeftButton, {}, start);
        for (const double share : {0.5, 1.0}) {
            const QPointF position = start + share * QPointF(end - start);
            QMouseEvent move(QEvent::MouseMove, position, canvas->mapToGlobal(position), Qt::NoButton, Qt::LeftButton,
                             {});
            QCoreApplication::sendEvent(canvas, &move);
        }
        QTest::mouseRelease(canvas, Qt::LeftButton, {}, end);
    }
    QAction *action(const QKeySequence &key)
    {
        for (const QAction *menu : m_window->menuBar()->actions())
            for (QAction *one : menu->menu()->actions())
                if (one->shortcut() == key)
                    return one;
        return nullptr;
    }

private slots:
    void initTestCase()
    {
        QVERIFY(open(R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 60,
                       "lines": [{"frequencyHz": 150, "snrDb": 10, "referenceSeconds": 0.5}]})",
                     [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.5; }, {1280, 800}));
        m_window->activateWindow();
        input().setFocus();
        QVERIFY(QTest::qWaitForWindowActive(m_window.get()));
    }

    void aBoxTellsItsAreaSnr()
    {
        QTest::keyClick(&input(), Qt::Key_M);
        QVERIFY(input().display().isMeasuring() && output().display().isMeasuring());
        drag(input(), {5.0, 138.0}, {55.0, 162.0});
        QTRY_VERIFY_WITH_TIMEOUT(boxText(input()).contains("area SNR"), patience);
        QCOMPARE(boxText(output()).section('\n', -1), boxText(input()).section('\n', -1));
        // 100 windows: the line's beat with the noise, and the noise of 12 cells, leave √(32/100) of 10.
        const double db = boxText(input()).section("area SNR ", 1).section(' ', 0, 0).toDouble();
        QVERIFY2(std::abs(std::pow(10.0, 0.1 * db) - 10.0) < 4.0 * std::sqrt(32.0 / 100.0),
                 qPrintable(boxText(input())));
        for (const char *word : {"Δt", "Δf", "Hz/s", "peak", "mean"})
            QVERIFY2(boxText(input()).contains(QString::fromUtf8(word)), word);
        drag(input(), {5.0, 300.0}, {55.0, 302.0});
        QVERIFY(!boxText(input()).contains("SNR 10"));
        QTest::keyClick(&input(), Qt::Key_Escape);
        QVERIFY(boxText(input()).isEmpty());
    }

    void sidebandsAreInBothPictures()
    {
        viewport().setCursor({30.0, 250.0});
        QAction *sidebands = action(Qt::Key_I);
        QVERIFY(sidebands);
        QTest::keyClick(&input(), Qt::Key_I);
        QVERIFY(sidebands->isChecked());
        QVERIFY(input().display().sidebandSpacing() > 0.0);
        QCOMPARE(output().display().sidebandSpacing(), input().display().sidebandSpacing());
        drag(output(), {10.0, 250.0 + output().display().sidebandSpacing()}, {10.0, 280.0});
        QVERIFY2(std::abs(input().display().sidebandSpacing() - 30.0) < 2.0,
                 qPrintable(QString::number(input().display().sidebandSpacing())));
        QCOMPARE(output().display().sidebandSpacing(), input().display().sidebandSpacing());
        QTest::keyClick(&input(), Qt::Key_Escape);
        QVERIFY(!sidebands->isChecked());
        QCOMPARE(output().display().sidebandSpacing(), 0.0);
    }

    void theCursorFindsTheLine()
    {
        viewport().setCursor({30.0, 146.0});
        QVERIFY(action(Qt::Key_K));
        QTest::keyClick(&input(), Qt::Key_K);
        QVERIFY2(std::abs(viewport().cursor()->hz - 150.0) <= 1.0,
                 qPrintable(QString::number(viewport().cursor()->hz)));
    }
};

FAINTLINE_WINDOW_TEST(tst_Measure)
#include "tst_Measure.moc"
