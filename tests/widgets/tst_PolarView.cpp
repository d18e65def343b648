#include "support/test.h"
#include "widgets/pings/PolarView.h"

#include "pingPictures.h"
#include "pixels.h"
#include "widgets/base/Theme.h"
#include "widgets/pings/PolarItem.h"

#include <qwt_text.h>

#include <QMenu>
#include <QWheelEvent>

#include <cmath>
#include <limits>

using namespace faintline;
using namespace faintline::test;

/// A ping from above: it looks as the plane it belongs to, and mouse and keys do to it what they do there.
class tst_PolarView : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void init()
    {
        m_viewport.setExtents({995.0, 1495.0}, {-22.5, 337.5}, 40.0, 45.0);
        m_plane = std::make_unique<WaterfallView>("Statistic");
        m_plane->setViewport(&m_viewport);
        m_plane->display().setColourMap("grey");
        m_plane->setPicture(pingPicture(40, 2, 1), bearingAxis); // 1400 m, 90°: east
        m_plane->setRange(0.0, 30.0);
        m_polar = std::make_unique<PolarView>(*m_plane);
        m_polar->followPicture();
        test::show(*m_polar, {500, 400});
    }

    void cleanup()
    {
        m_polar.reset();
        m_plane.reset();
    }

    void placesReadBack_data()
    {
        QTest::addColumn<double>("range");
        QTest::addColumn<double>("bearing");
        for (const double bearing : {-22.0, 0.0, 89.0, 180.0, 270.0, 337.0})
            QTest::addRow("%g", bearing) << 1234.0 << bearing;
    }

    void placesReadBack()
    {
        QFETCH(double, range);
        QFETCH(double, bearing);
        const PingMarks::Place place = m_polar->placeAt(m_polar->positionOf({range, bearing}));
        QVERIFY(std::abs(place.along - range) < 1e-6);
        QVERIFY(std::abs(place.across - bearing) < 1e-6); // on the axis: -22°, not 338°
    }

    void coloursFollowThePlane()
    {
        QCOMPARE(at(1400.0, 80.0), qRgb(255, 255, 255));
        QVERIFY(qGray(at(1400.0, 260.0)) < 20);
        m_plane->setRange(0.0, 60.0);
        QVERIFY(std::abs(qGray(at(1400.0, 80.0)) - 128) <= 2);
        m_plane->display().setColourMap("paper");
        QVERIFY(qGray(at(1400.0, 260.0)) > 235);
        m_plane->setPicture(pingPicture(40, 6, 1), bearingAxis); // west
        m_plane->setRange(0.0, 30.0);
        m_polar->followPicture();
        QVERIFY(qGray(at(1400.0, 260.0)) < 20);
        QVERIFY(qGray(at(1400.0, 80.0)) > 235);
    }

    void theContourFollowsTheThreshold()
    {
        const QRgb contour = Theme::colours(*m_polar).contour.rgb();
        QVERIFY(!test::coloursOf(*m_polar).contains(contour));
        m_plane->setThreshold(12.0);
        QVERIFY(test::coloursOf(*m_polar).contains(contour));
        m_plane->display().setLayer(PictureDisplay::ThresholdLayer, false);
        QVERIFY(!test::coloursOf(*m_polar).contains(contour));
        m_plane->display().setLayer(PictureDisplay::ThresholdLayer, true);
        m_plane->setThreshold(std::numeric_limits<double>::quiet_NaN()); // none
        QVERIFY(!test::coloursOf(*m_polar).contains(contour));
    }

    void aSectorFillsTheCanvas()
    {
        m_viewport.zoomTo({1200.0, 1400.0}, {45.0, 90.0});
        const QRectF canvas = QRectF(m_polar->canvas()->rect()).adjusted(-1, -1, 1, 1);
        QRectF bounds;
        for (const double range : {1200.0, 1400.0})
            for (double bearing = 45.0; bearing <= 90.0; bearing += 5.0) {
                const QPointF position = m_polar->positionOf({range, bearing});
                QVERIFY2(canvas.contains(position), qPrintable(QString::number(bearing)));
                bounds |= QRectF(position, QSizeF(1.0, 1.0));
            }
        QVERIFY(bounds.width() > 0.9 * canvas.width() || bounds.height() > 0.9 * canvas.height());
    }

    void ctrlAndWheelZoomAboutThePointer()
    {
        const PingMarks::Place place{1300.0, 120.0};
        wheel(m_polar->positionOf(place), 2, Qt::ControlModifier);
        QVERIFY(m_isWheelTaken);
        QVERIFY(std::abs(m_viewport.time().width() - 500.0 / 1.5625) < 1e-6);
        QVERIFY(m_viewport.time().contains(place.along) && m_viewport.frequency().contains(place.across));
        wheel(m_polar->positionOf(place), -2, Qt::ControlModifier);
        QVERIFY(std::abs(m_viewport.time().width() - 500.0) < 1e-6);
    }

    void aPlainWheelIsLeftToOthers()
    {
        wheel(m_polar->positionOf({1300.0, 120.0}), 1, {});
        QVERIFY(!m_isWheelTaken);
        QVERIFY(m_viewport.showsAll());
    }

    void hoveringTellsThePlaceAndItsEnd()
    {
        QSignalSpy hovered(m_polar.get(), &PolarView::hovered), ended(m_polar.get(), &PolarView::hoverEnded);
        QTest::mouseMove(m_polar->canvas(), m_polar->positionOf({1300.0, 120.0}).toPoint());
        QCOMPARE(hovered.count(), 1);
        QVERIFY(std::abs(hovered[0][0].toDouble() - 1300.0) < 12.0);
        QVERIFY(std::abs(hovered[0][1].toDouble() - 120.0) < 1.0);
        QTest::mouseMove(m_polar->canvas(), m_polar->positionOf({0.0, 0.0}).toPoint()); // nearer than any cell
        QCOMPARE(hovered.count(), 1);
        QCOMPARE(ended.count(), 1);
        QEvent leave(QEvent::Leave);
        QCoreApplication::sendEvent(m_polar->canvas(), &leave);
        QCOMPARE(ended.count(), 2);
    }

    void keysActOnThePlane()
    {
        m_viewport.setCursor({1300.0, 90.0});
        QTest::keyClick(m_polar.get(), Qt::Key_Up);
        QCOMPARE(*m_viewport.cursor(), (Viewport::Point{1310.0, 90.0}));
        QTest::keyClick(m_polar.get(), Qt::Key_Right);
        QCOMPARE(*m_viewport.cursor(), (Viewport::Point{1310.0, 135.0}));
        QTest::keyClick(m_polar.get(), Qt::Key_C);
        QVERIFY(m_plane->display().colourMap().name() != "grey");
    }

    void theMenuIsThePlanes()
    {
        Viewport::Point asked;
        bool hasCommands = false;
        connect(m_plane.get(), &WaterfallView::contextMenuRequested, this,
                [&](QMenu *menu, double range, double bearing) {
                    asked = {range, bearing};
                    for (const QAction *action : menu->actions())
                        hasCommands = hasCommands || action->text() == "Show all\t0";
                    QTimer::singleShot(0, menu, &QMenu::close);
                });
        const QPoint position = m_polar->canvas()->mapTo(m_polar.get(), m_polar->positionOf({1250.0, 225.0}).toPoint());
        QContextMenuEvent event(QContextMenuEvent::Mouse, position, m_polar->mapToGlobal(position));
        QCoreApplication::sendEvent(m_polar.get(), &event);
        QVERIFY(hasCommands);
        QVERIFY(std::abs(asked.seconds - 1250.0) < 12.0);
        QVERIFY(std::abs(asked.hz - 225.0) < 1.0);
    }

    void withoutAPictureNothingHappens()
    {
        m_plane->setPicture(nullptr, {});
        m_polar->followPicture();
        QSignalSpy hovered(m_polar.get(), &PolarView::hovered);
        const QPoint middle = m_polar->canvas()->rect().center();
        QTest::mouseMove(m_polar->canvas(), middle + QPoint(40, 0));
        QTest::mouseClick(m_polar->canvas(), Qt::LeftButton, {}, middle + QPoint(60, 0));
        QTest::keyClick(m_polar.get(), Qt::Key_Up);
        QCOMPARE(hovered.count(), 0);
        QVERIFY(!m_viewport.cursor());
        QVERIFY(!m_polar->grab().isNull());
    }

    void itKeepsItsShapeOnAnyCanvas()
    {
        for (const QSize size : {QSize(900, 300), QSize(300, 800), m_polar->minimumSizeHint()}) {
            m_polar->resize(size);
            QCoreApplication::processEvents();
            const QPointF origin = m_polar->positionOf({0.0, 0.0});
            const QRectF canvas = QRectF(m_polar->canvas()->rect());
            double length = 0.0;
            for (const double bearing : {0.0, 90.0, 180.0, 270.0}) {
                const QPointF end = m_polar->positionOf({1495.0, bearing});
                QVERIFY(canvas.contains(end)); // all of it is seen
                const double here = std::hypot(end.x() - origin.x(), end.y() - origin.y());
                QVERIFY(length == 0.0 || std::abs(here - length) < 1.0);
                length = here;
            }
            QVERIFY(2.0 * length > 0.9 * std::min(canvas.width(), canvas.height()));
        }
    }

    void whatIsNoNumberIsDark()
    {
        std::vector<float> values(std::size_t(ranges * beams), -std::numeric_limits<float>::infinity()); // ln 0
        for (const Index range : {39, 40, 41})
            values[std::size_t(range * beams + 2)] = std::numeric_limits<float>::infinity();
        m_plane->setPicture(pictureOf(rangeAxis, bearingAxis, values, ByteScale(ByteScale::Kind::ScoreNats)),
                            bearingAxis);
        m_plane->setRange(0.0, 30.0);
        m_polar->followPicture();
        QCOMPARE(at(1400.0, 80.0), qRgb(255, 255, 255));
        QCOMPARE(at(1400.0, 260.0), qRgb(0, 0, 0));
    }

    void themesChangeTheGround()
    {
        for (const Theme::Kind kind : {Theme::Kind::Dark, Theme::Kind::Light}) {
            m_polar->setPalette(Theme::palette(kind));
            const QRgb ground = Theme::palette(kind).color(QPalette::Window).rgb();
            QCOMPARE(test::colourAt(test::imageOf(*m_polar), {8.0, 8.0}), ground); // beyond the last range
            QCOMPARE(at(1400.0, 80.0), qRgb(255, 255, 255));                       // colours are values' own
        }
    }

    void itCanBeHeard()
    {
        QVERIFY2(m_polar->accessibleName().endsWith(", from above"), qPrintable(m_polar->accessibleName()));
        QVERIFY(m_polar->accessibleName().size() > int(qstrlen(", from above")));
        QVERIFY(m_polar->focusPolicy() & Qt::TabFocus);
        QTest::mouseClick(m_polar->canvas(), Qt::LeftButton, {}, m_polar->positionOf({1300.0, 120.0}).toPoint());
        QVERIFY(m_polar->hasFocus());
        QVERIFY(test::coloursOf(m_polar->grab().toImage()).contains(Theme::colours(*m_polar).accent.rgb()));
    }

private:
    QRgb at(double range, double bearing) const
    {
        return test::colourAt(test::imageOf(*m_polar), m_polar->positionOf({range, bearing}));
    }
    void wheel(const QPointF &onCanvas, int notches, Qt::KeyboardModifiers modifiers) const
    {
        const QPointF position = m_polar->canvas()->mapTo(m_polar.get(), onCanvas);
        QWheelEvent event(position, m_polar->mapToGlobal(position), {}, {0, 120 * notches}, Qt::NoButton, modifiers,
                          Qt::NoScrollPhase, false);
        event.ignore();
        QCoreApplication::sendEvent(m_polar.get(), &event);
        m_isWheelTaken = event.isAccepted();
    }

    Viewport m_viewport;
    std::unique_ptr<WaterfallView> m_plane;
    std::unique_ptr<PolarView> m_polar;
    mutable bool m_isWheelTaken = false;
};

FAINTLINE_WINDOW_TEST(tst_PolarView)
#include "tst_PolarView.moc"
