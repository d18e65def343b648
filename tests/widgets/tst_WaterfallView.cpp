#include "support/test.h"
#include "widgets/waterfall/WaterfallView.h"

#include "pictures.h"
#include "pixels.h"
#include "support/find.h"
#include "widgets/base/Theme.h"
#include "widgets/waterfall/OverlayItem.h"

#include <qwt_scale_draw.h>
#include <qwt_text.h>

#include <QMenu>

#include <cmath>

using namespace faintline;

/// The gestures of a waterfall, and that its picture depends on nothing but what it is told.
class tst_WaterfallView : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void init()
    {
        const auto picture =
            test::picture(100, 200, [](Index f, Index c) { return f == 40 && c == 50 ? 30.0f : 1.0f; });
        const Axis hz = test::hzAxis(200);
        const Viewport::Box box = WaterfallView::extents(picture->time(), hz);
        m_viewport.setExtents(box.time, box.frequency, 2.0, 4.0);
        m_view = std::make_unique<WaterfallView>("Statistic");
        m_view->setViewport(&m_viewport);
        m_view->setPicture(picture, hz);
        test::show(*m_view, {500, 400});
    }

    void cleanup()
    {
        m_view.reset();
        m_viewport.setLogarithmic(false);
    }

    void wheelScrollsAndZooms()
    {
        m_viewport.zoomTo({40.0, 60.0}, {200.0, 300.0});
        const QPointF centre = m_view->canvas()->geometry().center();
        wheel(centre, 1);
        QCOMPARE(m_viewport.time().low, 42.0); // newest on top: upwards is later
        wheel(centre, -1);
        QCOMPARE(m_viewport.time().low, 40.0);
        wheel(centre, -1, Qt::ShiftModifier);
        QCOMPARE(m_viewport.frequency().low, 210.0);
        QCOMPARE(m_viewport.time().low, 40.0);

        const Viewport::Point before = m_view->pointAt(m_view->canvas()->mapFrom(m_view.get(), centre));
        wheel(centre, 2, Qt::ControlModifier);
        const Viewport::Point after = m_view->pointAt(m_view->canvas()->mapFrom(m_view.get(), centre));
        QVERIFY(std::abs(m_viewport.time().width() - 20.0 / 1.5625) < 1e-9);
        QVERIFY(std::abs(before.seconds - after.seconds) < 1e-6);
        QVERIFY(std::abs(before.hz - after.hz) < 1e-6);
    }

    void wheelOverAnAxisZoomsThatAxis()
    {
        const QRect canvas = m_view->canvas()->geometry();
        wheel(QPointF(canvas.left() - 12, canvas.center().y()), 1);
        QVERIFY(std::abs(m_viewport.time().width() - 80.0) < 1e-9);
        QCOMPARE(m_viewport.frequency().width(), 400.0);
        wheel(QPointF(canvas.center().x(), canvas.bottom() + 12), 1);
        QVERIFY(std::abs(m_viewport.frequency().width() - 320.0) < 1e-9);
        QVERIFY(std::abs(m_viewport.time().width() - 80.0) < 1e-9);
    }

    void dragPans()
    {
        m_viewport.zoomTo({40.0, 60.0}, {200.0, 300.0});
        const QPoint from = pixel(50.0, 250.0), to = pixel(45.0, 240.0);
        drag(from, to);
        const Viewport::Point held = m_view->pointAt(to); // what was under the pointer still is
        QVERIFY(std::abs(held.seconds - 50.0) < 0.1);
        QVERIFY(std::abs(held.hz - 250.0) < 0.5);
        QVERIFY(!m_viewport.cursor());
        QCOMPARE(m_viewport.time().width(), 20.0);
    }

    void shiftDragZoomsToABox()
    {
        drag(pixel(20.0, 200.0), pixel(60.0, 300.0), Qt::ShiftModifier);
        QVERIFY(std::abs(m_viewport.time().low - 20.0) < 0.3);
        QVERIFY(std::abs(m_viewport.time().high - 60.0) < 0.3);
        QVERIFY(std::abs(m_viewport.frequency().low - 200.0) < 1.0);
        QVERIFY(std::abs(m_viewport.frequency().high - 300.0) < 1.0);
        QTest::keyClick(m_view.get(), Qt::Key_Backspace);
        QVERIFY(m_viewport.showsAll());
    }

    void clickPlacesTheCursor()
    {
        QTest::mouseClick(m_view->canvas(), Qt::LeftButton, {}, pixel(30.0, 222.0));
        QVERIFY(m_viewport.cursor());
        QVERIFY(std::abs(m_viewport.cursor()->seconds - 30.0) < 0.2);
        QVERIFY(std::abs(m_viewport.cursor()->hz - 222.0) < 0.6);
        QVERIFY(m_viewport.showsAll());
    }

    void keys()
    {
        QSignalSpy threshold(m_view.get(), &WaterfallView::thresholdStepRequested);
        QTest::keyClick(m_view.get(), Qt::Key_Comma);
        QTest::keyClick(m_view.get(), Qt::Key_Period);
        QCOMPARE(threshold.count(), 2);
        QCOMPARE(threshold[0][0].toInt(), -1);
        QCOMPARE(threshold[1][0].toInt(), 1);

        QSignalSpy orientation(&m_view->direction(), &TimeDirection::changed);
        for (int i = 0; i < 3; ++i)
            QTest::keyClick(m_view.get(), Qt::Key_O);
        QCOMPARE(orientation.count(), 3);
        QCOMPARE(m_view->direction().orientation(), WaterfallView::Orientation::NewestOnTop);

        QTest::keyClick(m_view.get(), Qt::Key_C);
        QCOMPARE(m_view->display().colourMap().name(), ColourMap::names()[1]);

        m_viewport.zoomTo({40.0, 60.0}, {200.0, 300.0});
        QTest::keyClick(m_view.get(), Qt::Key_0);
        QVERIFY(m_viewport.showsAll());

        m_viewport.setCursor({30.0, 200.0});
        QTest::keyClick(m_view.get(), Qt::Key_Escape);
        QVERIFY(!m_viewport.cursor());
    }

    void hoverReadsOut()
    {
        QSignalSpy hovered(m_view.get(), &WaterfallView::hovered), ended(m_view.get(), &WaterfallView::hoverEnded);
        QTest::mouseMove(m_view->canvas(), pixel(40.5, 200.0));
        QCOMPARE(hovered.count(), 1);
        QVERIFY(std::abs(hovered[0][0].toDouble() - 40.5) < 0.2);
        QCOMPARE(hovered[0][2].toDouble(), 30.0);
        QEvent leave(QEvent::Leave);
        QCoreApplication::sendEvent(m_view->canvas(), &leave);
        QCOMPARE(ended.count(), 1);
    }

    void doubleClickActivatesAnEvent()
    {
        m_view->setEvents({test::event(7, 30.0, 50.0, 220.0), test::event(8, 60.0, 70.0, 400.0)});
        QSignalSpy activated(m_view.get(), &WaterfallView::eventActivated);
        QTest::mouseDClick(m_view->canvas(), Qt::LeftButton, {}, pixel(40.0, 220.0));
        QCOMPARE(activated.count(), 1);
        QCOMPARE(activated[0][0].toInt(), 7);
        QTest::mouseDClick(m_view->canvas(), Qt::LeftButton, {}, pixel(90.0, 150.0));
        QCOMPARE(activated.count(), 1);
    }

    void measuring()
    {
        QTest::keyClick(m_view.get(), Qt::Key_M);
        QVERIFY(m_view->display().isMeasuring());
        drag(pixel(20.0, 200.0), pixel(60.0, 300.0));
        QVERIFY(m_viewport.selection());
        QVERIFY(std::abs(m_viewport.selection()->time.width() - 40.0) < 0.5);
        QVERIFY(m_viewport.showsAll());
        QTest::keyClick(m_view.get(), Qt::Key_M);
        QVERIFY(!m_viewport.selection());
    }

    void theCursorDoesNotCrossOutWhatWasMeasured()
    {
        QTest::keyClick(m_view.get(), Qt::Key_M);
        drag(pixel(60.0, 200.0), pixel(90.0, 300.0));
        const Viewport::Box box = *m_viewport.selection();
        // Its figures stand below its lower left corner, in time upwards; the cursor's line goes through them, its crossing
        // is elsewhere.
        const QPoint corner = pixel(box.time.low, box.frequency.low);
        const QRect figures(m_view->canvas()->mapTo(m_view.get(), corner) + QPoint(6, 10), QSize(40, 8));
        const auto grab = [&] { return m_view->grab().toImage(); };
        m_viewport.setCursor({95.0, 480.0});
        const QImage without = grab();
        m_viewport.setCursor({95.0, box.frequency.low + 12.0});
        const QImage with = grab();
        QVERIFY(with.copy(figures) == without.copy(figures));
        QVERIFY(with != without);
    }

    void theMeasuredBoxSnapsToPeaks()
    {
        // The one strong cell is at frame 40, bin 50: 40 s, 200 Hz.
        const Viewport::Point peak{40.5, test::hzAxis(200).value(50)}; // frame 40
        QTest::keyClick(m_view.get(), Qt::Key_M);
        const QPoint near = m_view->positionOf(peak).toPoint() + QPoint(7, -6);
        drag(near, pixel(70.0, 300.0), Qt::ControlModifier);
        QVERIFY(m_viewport.selection());
        QCOMPARE(m_viewport.selection()->time.low, peak.seconds);
        QCOMPARE(m_viewport.selection()->frequency.low, peak.hz);
        drag(near, pixel(70.0, 300.0));
        QVERIFY(m_viewport.selection()->frequency.low != peak.hz);
        drag(pixel(20.0, 120.0), near, Qt::ControlModifier); // the corner that moves as well
        QCOMPARE(m_viewport.selection()->time.high, peak.seconds);
        QCOMPARE(m_viewport.selection()->frequency.high, peak.hz);
        m_view->setSelectionNote("area SNR 3.0 dB");
        QVERIFY(overlay().selectionText.endsWith("area SNR 3.0 dB"));
        drag(pixel(20.0, 120.0), pixel(30.0, 140.0));
        QVERIFY(!overlay().selectionText.contains("area")); // it was another box's
    }

    void theCursorGoesToThePeak()
    {
        const Viewport::Point peak{40.5, test::hzAxis(200).value(50)}; // frame 40
        const QPoint near = m_view->positionOf(peak).toPoint() + QPoint(-8, 5);
        QTest::mouseClick(m_view->canvas(), Qt::LeftButton, Qt::ControlModifier, near);
        QCOMPARE(m_viewport.cursor().value(), peak);
        QTest::mouseClick(m_view->canvas(), Qt::LeftButton, {}, near);
        QVERIFY(m_viewport.cursor().value() != peak);
        QTest::keyClick(m_view.get(), Qt::Key_K);
        QCOMPARE(m_viewport.cursor().value(), peak);
        QTest::mouseClick(m_view->canvas(), Qt::LeftButton, Qt::ControlModifier, near + QPoint(0, 60)); // too far
        QVERIFY(m_viewport.cursor().value() != peak);
    }

    void sidebandsAreDragged()
    {
        m_viewport.setCursor({40.5, 300.0});
        QSignalSpy changed(&m_view->display(), &PictureDisplay::linesChanged);
        QTest::keyClick(m_view.get(), Qt::Key_I);
        const double before = m_view->display().sidebandSpacing();
        QVERIFY(before > 0.0);
        QCOMPARE(changed.count(), 1);
        QVERIFY2(overlay().sidebandText.contains("carrier 300"), qPrintable(overlay().sidebandText));
        drag(pixel(70.0, 300.0 - 2.0 * before), pixel(60.0, 220.0)); // the second one below
        QVERIFY2(std::abs(m_view->display().sidebandSpacing() - 40.0) < 1.0,
                 qPrintable(QString::number(m_view->display().sidebandSpacing())));
        QCOMPARE(m_viewport.cursor()->hz, 300.0);
        QVERIFY(m_viewport.showsAll());
        // With Ctrl onto the peak at 200 Hz: the line has its level.
        const double peak = test::hzAxis(200).value(50);
        drag(pixel(40.0, 300.0 - 2.0 * m_view->display().sidebandSpacing()),
             m_view->positionOf({40.5, peak}).toPoint() + QPoint(5, 3), Qt::ControlModifier);
        QCOMPARE(m_view->display().sidebandSpacing(), (300.0 - peak) / 2.0);
        QVERIFY2(overlay().sidebandText.contains("30.0"), qPrintable(overlay().sidebandText));
        // Beside the lines one still pans.
        m_viewport.zoomTo({20.0, 60.0}, {200.0, 400.0});
        const double low = m_viewport.frequency().low;
        drag(pixel(40.0, 325.0), pixel(40.0, 335.0));
        QVERIFY(m_viewport.frequency().low < low);
    }

    void sidebandsByKey()
    {
        QTest::keyClick(m_view.get(), Qt::Key_I);
        QVERIFY(m_viewport.cursor()); // where there was none
        m_viewport.setCursor({40.5, 300.0});
        QTest::keyClick(m_view.get(), Qt::Key_Right);
        QCOMPARE(m_viewport.cursor()->hz, 300.0 + m_view->frequencyAxis().step); // the carrier goes with the cursor
    }

    void levelsAndAutomaticRange()
    {
        const Span automatic = m_view->range();
        QVERIFY(m_view->isRangeAutomatic());
        QTest::keyClick(m_view.get(), Qt::Key_BracketRight);
        QCOMPARE(m_view->range().low, automatic.low + 0.5);
        QTest::keyClick(m_view.get(), Qt::Key_BracketLeft);
        QTest::keyClick(m_view.get(), Qt::Key_BraceRight);
        QCOMPARE(m_view->range().low, automatic.low);
        QCOMPARE(m_view->range().high, automatic.high + 0.5);
        QTest::keyClick(m_view.get(), Qt::Key_BraceLeft);
        QVERIFY(!m_view->isRangeAutomatic());
        m_view->setRange(3.0, 3.0);
        QVERIFY(m_view->range().width() > 0.0);
        QTest::keyClick(m_view.get(), Qt::Key_A);
        QCOMPARE(m_view->range(), automatic);
    }

    void scrollingKeepsTheLevels()
    {
        // Quiet at first, loud later.
        m_view->setPicture(
            test::picture(100, 200, [](Index f, Index c) { return float(f < 50 ? c % 3 : 20 + c % 30); }),
            test::hzAxis(200));
        m_viewport.zoomTo({0.0, 20.0}, {100.0, 200.0});
        m_view->grab();
        const Span quiet = m_view->range();
        QVERIFY(m_view->isRangeAutomatic());
        QSignalSpy changed(m_view.get(), &WaterfallView::rangeChanged);
        for (const double seconds : {20.0, 40.0, 60.0, 80.0}) {
            m_viewport.zoomTo({seconds, seconds + 20.0}, {300.0, 400.0});
            m_view->grab();
            QCOMPARE(m_view->range(), quiet);
        }
        QCOMPARE(changed.count(), 0);
    }

    void valueAtEveryCell()
    {
        QCOMPARE(m_view->valueAt(40.01, 199.1).value(), 30.0);
        QCOMPARE(m_view->valueAt(40.99, 200.9).value(), 30.0);
        QCOMPARE(m_view->valueAt(41.01, 200.0).value(), 1.0);
        QCOMPARE(m_view->valueAt(40.5, 201.1).value(), 1.0);
        QVERIFY(!m_view->valueAt(-0.1, 200.0));
        QVERIFY(!m_view->valueAt(40.0, 99.9 - 1.0));
        QVERIFY(!m_view->valueAt(101.0, 200.0));
    }

    void emptyAndBack()
    {
        const auto picture = m_view->picture();
        m_view->setEmptySentence("Nothing here.");
        m_view->setPicture(nullptr, {});
        m_view->grab();
        QTest::keyClick(m_view.get(), Qt::Key_O);
        wheel(m_view->canvas()->geometry().center(), 1);
        QTest::mouseClick(m_view->canvas(), Qt::LeftButton);
        QVERIFY(!m_viewport.cursor());
        m_view->setPicture(picture, test::hzAxis(200));
        QCOMPARE(m_view->valueAt(40.5, 200.0).value(), 30.0);
    }

    void everyOrientationShowsTheSameCell()
    {
        m_viewport.zoomTo({38.0, 44.0}, {190.0, 210.0});
        m_view->display().setColourMap("grey");
        m_view->setRange(0.0, 30.0);
        m_view->display().setLayer(PictureDisplay::CursorLayer, false);
        for (const auto orientation : {WaterfallView::Orientation::NewestOnTop, WaterfallView::Orientation::OldestOnTop,
                                       WaterfallView::Orientation::LeftToRight}) {
            m_view->direction().set(orientation);
            QCoreApplication::processEvents();
            const QImage image = m_view->canvas()->grab().toImage();
            QCOMPARE(qGreen(image.pixel(pixel(40.5, 200.0))), 255);
            QCOMPARE(qGreen(image.pixel(pixel(42.5, 200.0))), 9);
            QCOMPARE(qGreen(image.pixel(pixel(40.5, 204.0))), 9);
        }
    }

    void logarithmicFrequency()
    {
        constexpr double hotHz = 200.0;
        m_viewport.setLogarithmic(true);
        for (const auto orientation :
             {WaterfallView::Orientation::NewestOnTop, WaterfallView::Orientation::LeftToRight}) {
            m_view->direction().set(orientation);
            const Span visible = m_viewport.frequency();
            const QPointF low = m_view->positionOf({50.0, visible.low}),
                          high = m_view->positionOf({50.0, visible.high}),
                          middle = m_view->positionOf({50.0, std::sqrt(visible.low * visible.high)});
            QVERIFY((middle - 0.5 * (low + high)).manhattanLength() < 1.0);
            QTest::mouseClick(m_view->canvas(), Qt::LeftButton, {}, pixel(40.5, hotHz));
            QVERIFY(m_viewport.cursor());
            const double pixelHz = hotHz * (std::pow(visible.high / visible.low, 1.0 / 300.0) - 1.0);
            QVERIFY(std::abs(m_viewport.cursor()->hz - hotHz) < 2.0 * pixelHz);
            QCOMPARE(m_view->valueAt(m_viewport.cursor()->seconds, m_viewport.cursor()->hz), std::optional(30.0));
            const QImage shown = m_view->canvas()->grab().toImage(); // the hot cell lies in the cursor's gap
            int brightest = 0;
            for (int dx = -1; dx <= 1; ++dx)
                for (int dy = -1; dy <= 1; ++dy)
                    brightest = std::max(brightest, qGray(shown.pixel(pixel(40.5, hotHz) + QPoint(dx, dy))));
            QVERIFY(brightest > qGray(shown.pixel(pixel(40.5, hotHz) + QPoint(40, 40))) + 60);
        }
        m_viewport.zoomTo(m_viewport.full().time, {120.0, 480.0});
        const QPoint from = pixel(50.0, 200.0), to = pixel(50.0, 220.0);
        drag(from, to);
        QVERIFY(std::abs(m_viewport.frequency().high / m_viewport.frequency().low - 4.0) < 1e-6); // ratios are kept
        QVERIFY(std::abs(m_view->pointAt(to).hz - 200.0) < 4.0);
    }

    void radioFrequency()
    {
        const QString offset = m_view->axisTitle(m_view->hzAxis()).text();
        m_viewport.setOriginHz(7.03e6);
        QCOMPARE(m_view->axisTitle(m_view->hzAxis()).text(), QString("Radio frequency (kHz)"));
        QVERIFY(m_view->axisScaleDraw(m_view->hzAxis())->label(200.0).text().startsWith("7030.2"));
        m_viewport.setOriginHz(0.0);
        QCOMPARE(m_view->axisTitle(m_view->hzAxis()).text(), offset);
    }

    void contextMenuOffersAndAsks()
    {
        QStringList texts;
        bool isAsked = false;
        connect(m_view.get(), &WaterfallView::contextMenuRequested, this, [&](QMenu *menu, double seconds, double hz) {
            isAsked = std::abs(seconds - 50.0) < 0.5 && std::abs(hz - 300.0) < 1.5;
            for (const QAction *action : menu->actions())
                texts << action->text();
            QTimer::singleShot(0, menu, &QMenu::close);
        });
        const QPoint position = m_view->canvas()->mapTo(m_view.get(), pixel(50.0, 300.0));
        QContextMenuEvent event(QContextMenuEvent::Mouse, position, m_view->mapToGlobal(position));
        QCoreApplication::sendEvent(m_view.get(), &event);
        QVERIFY(isAsked);
        QVERIFY(texts.contains("Show all\t0"));
    }

    void samePixelsTwice()
    {
        const auto draw = [&] {
            WaterfallView view("Statistic");
            Viewport viewport;
            const Viewport::Box &full = m_viewport.full();
            viewport.setExtents(full.time, full.frequency, 2.0, 4.0);
            view.setViewport(&viewport);
            view.setPicture(m_view->picture(), test::hzAxis(200));
            view.setEvents({test::event(1, 30.0, 50.0, 220.0)});
            view.setThreshold(12.0);
            viewport.setCursor({35.0, 250.0});
            viewport.zoomTo({10.0, 80.0}, {150.0, 400.0});
            view.resize(440, 330);
            return view.grab().toImage();
        };
        QCOMPARE(draw(), draw());
    }

    // A track that was looked at from both ends: the ribbon lies between 5 and 95 % of its position, round the selected one
    // only.
    void theSelectedTrackShowsItsBand()
    {
        Track track;
        track.id = 3;
        for (Index frame = 20; frame < 60; ++frame) {
            track.points.push_back({frame, 100, 0, 0.0});
            track.smoothed.push_back({100.3, 80.0f, 120.0f, 1.0f, 2.0f});
        }
        track.onsetFrame = 20;
        track.endFrame = 59;
        const Axis &time = m_view->picture()->time();
        const Axis hz = test::hzAxis(200);
        m_view->display().setLayer(PictureDisplay::TrackLayer, true);
        m_view->setTracks({track}, time);
        const QPoint inside = pixel(time.value(40.0), hz.value(90.0));
        const QPoint outside = pixel(time.value(40.0), hz.value(70.0));
        const QImage before = m_view->canvas()->grab().toImage();
        m_view->setSelectedEvent(3);
        const QImage after = m_view->canvas()->grab().toImage();
        if (const QByteArray file = qgetenv("FAINTLINE_LOOK"); !file.isEmpty())
            after.save(QString::fromLocal8Bit(file));
        QVERIFY(after.pixelColor(inside) != before.pixelColor(inside));
        QCOMPARE(after.pixelColor(outside), before.pixelColor(outside));
    }

private:
    const OverlayItem &overlay() const { return test::itemOf<OverlayItem>(*m_view); }
    void wheel(const QPointF &position, int notches, Qt::KeyboardModifiers modifiers = {})
    {
        const QPointF global = m_view->mapToGlobal(position);
        QWheelEvent event(position, global, {}, {0, 120 * notches}, Qt::NoButton, modifiers, Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(m_view.get(), &event);
    }

    void drag(const QPoint &from, const QPoint &to, Qt::KeyboardModifiers modifiers = {})
    {
        QWidget *canvas = m_view->canvas();
        QTest::mousePress(canvas, Qt::LeftButton, modifiers, from);
        for (const double share : {0.3, 0.7, 1.0}) {
            const QPointF position = from + share * QPointF(to - from);
            QMouseEvent move(QEvent::MouseMove, position, canvas->mapToGlobal(position), Qt::NoButton, Qt::LeftButton,
                             modifiers);
            QCoreApplication::sendEvent(canvas, &move);
        }
        QTest::mouseRelease(canvas, Qt::LeftButton, modifiers, to);
    }

    QPoint pixel(double seconds, double hz) const { return m_view->positionOf({seconds, hz}).toPoint(); }

    Viewport m_viewport;
    std::unique_ptr<WaterfallView> m_view;
};

FAINTLINE_WINDOW_TEST(tst_WaterfallView)
#include "tst_WaterfallView.moc"
