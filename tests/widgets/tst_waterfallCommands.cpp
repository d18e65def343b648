#include "support/test.h"
#include "widgets/waterfall/waterfallCommands.h"

#include "pictures.h"
#include "widgets/base/Theme.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QKeyEvent>
#include <QMenu>

using namespace faintline;

/// Keys and menu entries of a waterfall, without its window: which are its own, and what they do.
class tst_waterfallCommands : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void init()
    {
        const auto picture = test::picture(40, 50, [](Index f, Index c) { return f == 21 && c == 26 ? 30.0f : 1.0f; });
        const Viewport::Box full = WaterfallView::extents(picture->time(), test::hzAxis(50));
        m_viewport.setExtents(full.time, full.frequency, 2.0, 4.0); // 0 … 40 s, 99 … 199 Hz
        m_view = std::make_unique<WaterfallView>("Statistic");
        m_view->setViewport(&m_viewport);
        m_view->setPicture(picture, test::hzAxis(50));
        m_view->resize(500, 400);
        m_view->grab();
    }

    void cleanup() { m_view.reset(); }

    void withoutAPictureNoKeyIsItsOwn()
    {
        m_view->setPicture(nullptr, {});
        for (const int key : {Qt::Key_Left, Qt::Key_O, Qt::Key_Escape, Qt::Key_0})
            QVERIFY(!press(key));
        WaterfallView alone("Input"); // nor without a viewport
        QVERIFY(!pressKey(alone, QKeyEvent(QEvent::KeyPress, Qt::Key_Left, Qt::NoModifier)));
    }

    void otherKeysAreLeftToOthers()
    {
        for (const int key : {Qt::Key_Tab, Qt::Key_F1, Qt::Key_N, Qt::Key_Return, Qt::Key_Space, Qt::Key_P})
            QVERIFY(!press(key));
        QVERIFY(press(Qt::Key_O));
    }

    void withCtrlLettersAreLeftToOthers()
    {
        const auto before = m_view->direction().orientation();
        for (const Qt::KeyboardModifier modifier : {Qt::ControlModifier, Qt::AltModifier, Qt::MetaModifier})
            for (const int key : {Qt::Key_O, Qt::Key_A, Qt::Key_C, Qt::Key_0, Qt::Key_M})
                QVERIFY(!press(key, modifier));
        QCOMPARE(m_view->direction().orientation(), before);
        QVERIFY(!m_view->display().isMeasuring());
        QVERIFY(press(Qt::Key_BraceLeft, Qt::ShiftModifier)); // Shift is how some are typed
    }

    void theFirstArrowBeginsInTheMiddle()
    {
        QVERIFY(!m_viewport.cursor());
        QVERIFY(press(Qt::Key_Right));
        QVERIFY(std::abs(m_viewport.cursor()->seconds - 20.0) <= 0.5);
        QVERIFY(std::abs(m_viewport.cursor()->hz - 151.0) <= 1.0); // a bin further
    }

    void arrowsFollowTheOrientation_data()
    {
        using Orientation = WaterfallView::Orientation;
        QTest::addColumn<Orientation>("orientation");
        QTest::addColumn<int>("later"); // the keys for a frame later, and for a bin higher
        QTest::addColumn<int>("higher");
        QTest::newRow("newest on top") << Orientation::NewestOnTop << int(Qt::Key_Up) << int(Qt::Key_Right);
        QTest::newRow("oldest on top") << Orientation::OldestOnTop << int(Qt::Key_Down) << int(Qt::Key_Right);
        QTest::newRow("left to right") << Orientation::LeftToRight << int(Qt::Key_Right) << int(Qt::Key_Up);
    }

    void arrowsFollowTheOrientation()
    {
        QFETCH(WaterfallView::Orientation, orientation);
        QFETCH(int, later);
        QFETCH(int, higher);
        m_view->direction().set(orientation);
        m_view->grab();
        const Viewport::Point start{10.5, 140.0};
        m_viewport.setCursor(start);
        const QPointF before = m_view->positionOf(start);
        press(later);
        QCOMPARE(*m_viewport.cursor(), (Viewport::Point{11.5, 140.0}));
        press(higher);
        QCOMPARE(*m_viewport.cursor(), (Viewport::Point{11.5, 142.0}));
        // On the screen it goes where the arrow points: right, and up unless that key goes down.
        const QPointF moved = m_view->positionOf(*m_viewport.cursor()) - before;
        QVERIFY(moved.x() > 0.0);
        QCOMPARE(moved.y() < 0.0, later != Qt::Key_Down);
    }

    void ctrlGoesTenCells()
    {
        m_viewport.setCursor({10.7, 140.9}); // from the middle of its cell
        QVERIFY(press(Qt::Key_Up, Qt::ControlModifier));
        QVERIFY(press(Qt::Key_Left, Qt::ControlModifier));
        QCOMPARE(*m_viewport.cursor(), (Viewport::Point{20.5, 120.0}));
    }

    void theCursorStaysInThePicture()
    {
        m_viewport.setCursor({39.5, 198.0});
        press(Qt::Key_Up, Qt::ControlModifier);
        press(Qt::Key_Right);
        QCOMPARE(*m_viewport.cursor(), (Viewport::Point{39.5, 198.0}));
        m_viewport.setCursor({3.5, 104.0});
        press(Qt::Key_Down, Qt::ControlModifier);
        press(Qt::Key_Left, Qt::ControlModifier);
        QCOMPARE(*m_viewport.cursor(), (Viewport::Point{0.5, 100.0}));
    }

    void aCursorThatLeavesTakesTheViewAlong()
    {
        m_viewport.zoomTo({10.0, 20.0}, {120.0, 140.0});
        m_viewport.setCursor({19.5, 130.0});
        press(Qt::Key_Up, Qt::ControlModifier);
        QVERIFY(m_viewport.time().contains(29.5));
        QCOMPARE(m_viewport.time().width(), 10.0);
        QCOMPARE(m_viewport.frequency(), (Span{120.0, 140.0}));
    }

    void escapeClearsAllThatIsMarked()
    {
        m_viewport.setCursor({10.5, 140.0});
        press(Qt::Key_M);
        press(Qt::Key_H);
        press(Qt::Key_I);
        m_viewport.setSelection({{10.0, 20.0}, {120.0, 140.0}});
        QVERIFY(m_view->display().isMeasuring() && m_view->display().hasHarmonics()
                && m_view->display().sidebandSpacing() > 0.0);
        QVERIFY(press(Qt::Key_Escape));
        QVERIFY(!m_view->display().isMeasuring() && !m_view->display().hasHarmonics());
        QCOMPARE(m_view->display().sidebandSpacing(), 0.0);
        QVERIFY(!m_viewport.cursor() && !m_viewport.selection());
    }

    void sidebandsNeverComeCloserThanABin()
    {
        m_viewport.setCursor({10.5, 140.0});
        m_view->display().setSidebandSpacing(4.0);
        for (int i = 0; i < 5; ++i)
            QVERIFY(press(Qt::Key_Left, Qt::AltModifier));
        QCOMPARE(m_view->display().sidebandSpacing(), 2.0);
        QVERIFY(press(Qt::Key_Right, Qt::AltModifier));
        QCOMPARE(m_view->display().sidebandSpacing(), 4.0);
        QCOMPARE(m_viewport.cursor()->hz, 140.0);
    }

    void theMenuHasTheStateOfTheView()
    {
        m_viewport.setCursor({10.5, 140.0});
        m_view->direction().set(WaterfallView::Orientation::LeftToRight);
        m_view->setRange(1.0, 5.0);
        m_view->display().setLayer(PictureDisplay::TrackLayer, false);
        m_view->display().setMeasuring(true);
        QMenu menu;
        addCommands(menu, *m_view);
        for (const char *on : {"Left to right", "Events", "Measure a box"})
            QVERIFY2(entry(menu, on)->isChecked(), on);
        for (const char *off : {"Newest on top", "Automatic range", "Tracks", "Harmonics of the cursor"})
            QVERIFY2(!entry(menu, off)->isChecked(), off);
    }

    void everyEntryDoesWhatItSays()
    {
        m_viewport.setCursor({21.0, 151.0}); // beside the strong cell at 21.5 s, 152 Hz
        m_viewport.zoomTo({10.0, 30.0}, {120.0, 180.0});
        m_view->setRange(1.0, 5.0);
        QMenu menu;
        addCommands(menu, *m_view);
        entry(menu, "Cursor to the peak nearby")->trigger();
        QCOMPARE(*m_viewport.cursor(), (Viewport::Point{21.5, 152.0}));
        entry(menu, "Show all")->trigger();
        QVERIFY(m_viewport.showsAll());
        m_viewport.zoomTo({10.0, 30.0}, {120.0, 180.0});
        entry(menu, "Zoom back")->trigger();
        QVERIFY(m_viewport.showsAll());
        entry(menu, "Oldest on top")->trigger();
        QCOMPARE(m_view->direction().orientation(), WaterfallView::Orientation::OldestOnTop);
        entry(menu, "viridis")->trigger();
        QCOMPARE(m_view->display().colourMap().name(), QString("viridis"));
        entry(menu, "Automatic range")->trigger();
        QVERIFY(m_view->isRangeAutomatic());
        const Span automatic = m_view->range();
        entry(menu, "Automatic range")->trigger(); // once more: the colours stay as they are
        QVERIFY(!m_view->isRangeAutomatic());
        QVERIFY(m_view->range() == automatic);
        entry(menu, "Grid")->trigger();
        QVERIFY(m_view->display().shows(PictureDisplay::GridLayer));
        entry(menu, "Harmonics of the cursor")->trigger();
        QVERIFY(m_view->display().hasHarmonics());
        entry(menu, "Sidebands of the cursor")->trigger();
        QVERIFY(m_view->display().sidebandSpacing() > 0.0);
    }

    void coloursAreAllThereAndOneIsOn()
    {
        m_view->display().setColourMap("cividis");
        QMenu menu;
        addCommands(menu, *m_view);
        QStringList on;
        for (const QString &name : ColourMap::names()) {
            QVERIFY2(entry(menu, name), qPrintable(name));
            if (entry(menu, name)->isChecked())
                on << name;
        }
        QCOMPARE(on, QStringList{"cividis"});
        entry(menu, "grey")->trigger();
        QVERIFY(!entry(menu, "cividis")->isChecked()); // one of them at a time
    }

    void whatCannotBeDoneIsGrey()
    {
        QMenu whole;
        addCommands(whole, *m_view);
        for (const char *name : {"Show all", "Zoom back", "Cursor to the peak nearby"})
            QVERIFY2(!entry(whole, name)->isEnabled(), name);
        m_viewport.setCursor({10.5, 140.0});
        m_viewport.zoomTo({10.0, 30.0}, {120.0, 180.0});
        QMenu part;
        addCommands(part, *m_view);
        for (const char *name : {"Show all", "Zoom back", "Cursor to the peak nearby"})
            QVERIFY2(entry(part, name)->isEnabled(), name);
        WaterfallView alone("Input");
        QMenu none;
        addCommands(none, alone);
        QVERIFY(!entry(none, "Show all")->isEnabled());
    }

    void linesAreMeasuredInHertzOnly()
    {
        m_view->setPicture(m_view->picture(), {"bearing", "°", 0.0, 7.2, 50, true});
        QMenu menu;
        addCommands(menu, *m_view);
        QVERIFY(entry(menu, "Measure a box"));
        QVERIFY(!entry(menu, "Harmonics of the cursor"));
        QVERIFY(!entry(menu, "Sidebands of the cursor"));
        m_viewport.setCursor({10.5, 140.0});
        press(Qt::Key_I);
        QCOMPARE(m_view->display().sidebandSpacing(), 0.0);
    }

    void keysOfTheMenuAreTextOnly()
    {
        QMenu menu;
        addCommands(menu, *m_view);
        QCOMPARE(entry(menu, "Show all")->text(), QString("Show all\t0"));
        for (const QAction *action : menu.actions())
            QVERIFY(action->shortcut().isEmpty()); // it would take the key from the view
    }

private:
    bool press(int key, Qt::KeyboardModifiers modifiers = {}) const
    {
        return pressKey(*m_view, QKeyEvent(QEvent::KeyPress, key, modifiers));
    }
    /// The entry with that text, of the menu or one of those in it.
    static QAction *entry(const QMenu &menu, const QString &text)
    {
        for (QAction *action : menu.actions()) {
            if (action->text().section('\t', 0, 0) == text)
                return action;
            if (action->menu())
                if (QAction *found = entry(*action->menu(), text))
                    return found;
        }
        return nullptr;
    }

    Viewport m_viewport;
    std::unique_ptr<WaterfallView> m_view;
};

FAINTLINE_WINDOW_TEST(tst_waterfallCommands)
#include "tst_waterfallCommands.moc"
