#include "support/test.h"
#include "widgets/waterfall/LinkedPictures.h"

#include "pictures.h"
#include "pixels.h"
#include "support/find.h"
#include "widgets/base/Theme.h"
#include "widgets/waterfall/ColourBar.h"

using namespace faintline;
using Orientation = WaterfallPicture::Orientation;

namespace {

/// Power of noise about a level in dB, and of a line 10 dB above it in cell 5.
std::shared_ptr<const PeakPyramid> powerPicture(float levelDb)
{
    return test::picture(
        200, 10,
        [levelDb](Index frame, Index cell) {
            const float noiseDb = float((7 * frame + 3 * cell) % 11) - 5.0f;
            return std::pow(10.0f, 0.1f * (levelDb + (cell == 5 ? 10.0f : noiseDb)));
        },
        ByteScale::Kind::PowerDb);
}

} // namespace

/// Pictures with one range of colours.
class tst_LinkedPictures : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }
    void init()
    {
        m_viewport.setExtents({0.0, 200.0}, {99.0, 119.0}, 1.0, 2.0);
        m_direction.set(Orientation::NewestOnTop);
        m_display.setColourMap(ColourMap::defaultName());
        m_pictures = std::make_unique<LinkedPictures>(m_viewport, m_display, m_direction);
        m_pictures->setCount(3);
        const float levels[] = {0.0f, 15.0f, -5.0f};
        for (int place = 0; place < 3; ++place)
            m_pictures->at(place).setPicture(powerPicture(levels[place]), test::hzAxis(10));
        test::show(*m_pictures, {900, 500});
        QCoreApplication::processEvents();
    }
    void cleanup() { m_pictures.reset(); }

    void oneRangeHoldsThoseOfAll()
    {
        QVERIFY(unionOfRanges().high > m_pictures->at(0).automaticRange().high + 5.0);
        for (int place = 0; place < 3; ++place)
            QVERIFY(m_pictures->at(place).range() == unionOfRanges());
        QVERIFY(test::childOf<ColourBar>(*m_pictures).range() == unionOfRanges());
    }

    void anyPictureAndTheBarChangeTheRangeOfAll()
    {
        m_pictures->at(1).setRange(-3.0, 12.0);
        for (int place = 0; place < 3; ++place)
            QVERIFY((m_pictures->at(place).range() == Span{-3.0, 12.0}));
        emit test::childOf<ColourBar>(*m_pictures).rangeRequested(0.0, 25.0);
        for (int place = 0; place < 3; ++place)
            QVERIFY((m_pictures->at(place).range() == Span{0.0, 25.0}));
        m_viewport.zoomTo({50.0, 60.0}, {103.0, 113.0}); // stays
        QVERIFY((m_pictures->at(2).range() == Span{0.0, 25.0}));
        QTest::keyClick(&m_pictures->at(0), Qt::Key_A);
        for (int place = 0; place < 3; ++place)
            QVERIFY(m_pictures->at(place).range() == unionOfRanges());
    }

    void zoomAndCursorAreShared()
    {
        m_viewport.zoomTo({50.0, 100.0}, {103.0, 113.0});
        m_viewport.setCursor({70.0, 109.0});
        QPointF at = m_pictures->at(0).positionOf({70.0, 109.0});
        for (int place = 1; place < 3; ++place) {
            const QPointF here = m_pictures->at(place).positionOf({70.0, 109.0});
            QVERIFY(std::abs(here.y() - at.y()) <= 1.0 && std::abs(here.x() - at.x()) <= 2.0);
        }
        const QPointF from(30.0, 30.0), to(30.0, 90.0);
        WaterfallView &view = m_pictures->at(2);
        const double before = m_viewport.time().low;
        QTest::mousePress(view.canvas(), Qt::LeftButton, {}, from.toPoint());
        QMouseEvent move(QEvent::MouseMove, to, view.canvas()->mapToGlobal(to), Qt::NoButton, Qt::LeftButton, {});
        QCoreApplication::sendEvent(view.canvas(), &move);
        QTest::mouseRelease(view.canvas(), Qt::LeftButton, {}, to.toPoint());
        QVERIFY(m_viewport.time().low != before);
    }

    void aClickOrReturnChooses()
    {
        QSignalSpy chosen(m_pictures.get(), &LinkedPictures::chosen);
        WaterfallView &view = m_pictures->at(1);
        QTest::mouseClick(view.canvas(), Qt::LeftButton, {}, {20, 20});
        QCOMPARE(chosen.size(), 1);
        QCOMPARE(chosen.takeFirst().first().toInt(), 1);
        QVERIFY(m_viewport.cursor());
        QTest::keyClick(&m_pictures->at(2), Qt::Key_Return);
        QCOMPARE(chosen.size(), 1);
        QCOMPARE(chosen.takeFirst().first().toInt(), 2);
        QTest::mousePress(view.canvas(), Qt::LeftButton, {}, {20, 20}); // a drag does not
        QTest::mouseRelease(view.canvas(), Qt::LeftButton, {}, {60, 60});
        QTest::mouseClick(view.canvas(), Qt::RightButton, Qt::KeyboardModifiers(), {20, 20});
        QVERIFY(chosen.isEmpty());
    }

    void areStackedWhenTimeRunsFromLeftToRight()
    {
        const auto corner = [&](int place) { return m_pictures->at(place).mapTo(m_pictures.get(), QPoint()); };
        QCOMPARE(corner(0).y(), corner(2).y());
        QVERIFY(corner(1).x() >= corner(0).x() + 180 && corner(2).x() >= corner(1).x() + 180);
        m_direction.set(Orientation::LeftToRight);
        QCoreApplication::processEvents();
        QCOMPARE(corner(0).x(), corner(2).x());
        QVERIFY(corner(1).y() >= corner(0).y() + 110 && corner(2).y() >= corner(1).y() + 110);
        for (int place = 0; place < 3; ++place) {
            const WaterfallView &view = m_pictures->at(place);
            QCOMPARE(view.direction().orientation(), Orientation::LeftToRight);
            QCOMPARE(view.canvas()->mapTo(m_pictures.get(), QPoint()).x(),
                     m_pictures->at(0).canvas()->mapTo(m_pictures.get(), QPoint()).x());
            QCOMPARE(view.canvas()->width(), m_pictures->at(0).canvas()->width());
            QCOMPARE(view.isAxisVisible(QwtAxis::XBottom), place == 2);
        }
        m_direction.set(Orientation::OldestOnTop);
        QCoreApplication::processEvents();
        QCOMPARE(corner(0).y(), corner(2).y());
    }

    void fewerAreEmptied()
    {
        m_pictures->setCount(1);
        QVERIFY(m_pictures->at(0).isVisible() && !m_pictures->at(1).isVisible());
        QVERIFY(m_pictures->at(0).picture() && !m_pictures->at(1).picture());
        m_pictures->setCount(0);
        QVERIFY(!test::childOf<ColourBar>(*m_pictures).isVisible());
    }

    void colourMapIsShared()
    {
        QTest::keyClick(&m_pictures->at(1), Qt::Key_C);
        QVERIFY(m_pictures->at(1).display().colourMap().name() != ColourMap::defaultName());
        QCOMPARE(m_pictures->at(0).display().colourMap().name(), m_pictures->at(1).display().colourMap().name());
    }

private:
    Span unionOfRanges() const
    {
        Span all = m_pictures->at(0).automaticRange();
        for (int place = 1; place < 3; ++place) {
            const Span own = m_pictures->at(place).automaticRange();
            all = {std::min(all.low, own.low), std::max(all.high, own.high)};
        }
        return all;
    }

    Viewport m_viewport;
    PictureDisplay m_display;
    TimeDirection m_direction;
    std::unique_ptr<LinkedPictures> m_pictures;
};

FAINTLINE_WINDOW_TEST(tst_LinkedPictures)
#include "tst_LinkedPictures.moc"
