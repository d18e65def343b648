#include "support/test.h"
#include "widgets/waterfall/PictureDisplay.h"

#include "pictures.h"
#include "widgets/base/Theme.h"
#include "widgets/waterfall/WaterfallView.h"

using namespace faintline;

/// What pictures show alike has one owner: a gesture in one of them changes it for all that were given it.
class tst_PictureDisplay : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        Theme::apply(Theme::Kind::Light);
        m_viewport.setExtents(WaterfallView::extents(m_picture->time(), test::hzAxis(50)).time, {99.0, 199.0});
        m_viewport.setCursor({20.0, 120.0});
    }

    void gesturesInOnePictureChangeAll()
    {
        const auto first = shared(), second = shared();
        WaterfallView other("Other"); // has its own
        show(other);
        for (const int key : {Qt::Key_C, Qt::Key_O, Qt::Key_H, Qt::Key_I, Qt::Key_M})
            QTest::keyClick(first.get(), Qt::Key(key));
        QVERIFY(m_display.hasHarmonics() && m_display.isMeasuring() && m_display.sidebandSpacing() > 0.0);
        QCOMPARE(m_display.colourMap().name(), ColourMap::names()[1]);
        QCOMPARE(m_direction.orientation(), TimeDirection::Orientation::OldestOnTop);
        QVERIFY(second->sidebands());
        QCOMPARE(second->grab().toImage(), first->grab().toImage());
        QVERIFY(other.grab().toImage() != first->grab().toImage());
        QCOMPARE(other.display().colourMap().name(), ColourMap::defaultName());
        QVERIFY(!other.sidebands());
    }

    void aPictureMadeLaterHasItAtOnce()
    {
        const auto before = shared();
        m_direction.set(TimeDirection::Orientation::LeftToRight);
        m_display.setColourMap("viridis");
        m_display.setLayer(PictureDisplay::GridLayer, true);
        m_display.setLayer(PictureDisplay::CursorLayer, false);
        QCOMPARE(shared()->grab().toImage(), before->grab().toImage());
        QVERIFY(!shared()->isTimeVertical());
    }

    void theEndOfMeasuringClearsTheBoxOfEveryViewport()
    {
        Viewport ownViewport;
        ownViewport.setExtents(m_viewport.full().time, m_viewport.full().frequency);
        const auto first = shared(), second = shared();
        second->setViewport(&ownViewport);
        m_display.setMeasuring(true);
        for (Viewport *viewport : {&m_viewport, &ownViewport})
            viewport->setSelection({{10.0, 20.0}, {110.0, 120.0}});
        QTest::keyClick(first.get(), Qt::Key_M);
        QVERIFY(!m_viewport.selection() && !ownViewport.selection());
    }

    void tellsOfChangesOnly()
    {
        QSignalSpy colours(&m_display, &PictureDisplay::coloursChanged),
            layers(&m_display, &PictureDisplay::layersChanged);
        QSignalSpy lines(&m_display, &PictureDisplay::linesChanged), turned(&m_direction, &TimeDirection::changed);
        m_display.setColourMap(m_display.colourMap().name());
        m_display.setLayer(PictureDisplay::GridLayer, m_display.shows(PictureDisplay::GridLayer));
        m_display.setHarmonics(m_display.hasHarmonics());
        m_display.setSidebandSpacing(m_display.sidebandSpacing());
        m_direction.set(m_direction.orientation());
        QVERIFY(colours.isEmpty() && layers.isEmpty() && lines.isEmpty() && turned.isEmpty());
        m_display.setSidebandSpacing(m_display.sidebandSpacing() + 1.0);
        QCOMPARE(lines.size(), 1);
    }

private:
    std::unique_ptr<WaterfallView> shared()
    {
        auto view = std::make_unique<WaterfallView>("Input", &m_display, &m_direction);
        show(*view);
        return view;
    }

    void show(WaterfallView &view)
    {
        view.setViewport(&m_viewport);
        view.setPicture(m_picture, test::hzAxis(50));
        view.resize(500, 400);
        view.grab();
    }

    std::shared_ptr<const PeakPyramid> m_picture =
        test::picture(40, 50, [](Index f, Index c) { return f == 21 && c == 26 ? 30.0f : 1.0f; });
    Viewport m_viewport;
    PictureDisplay m_display;
    TimeDirection m_direction;
};

FAINTLINE_WINDOW_TEST(tst_PictureDisplay)
#include "tst_PictureDisplay.moc"
