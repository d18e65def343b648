// A walk over all widgets of the window in all its layouts: each can be named, reached, and no key means two things.

#include "app/commands/CommandPalette.h"
#include "app/commands/ToolBar.h"
#include "app/document/FrameKind.h"
#include "app/features/evaluate/InjectDialog.h"
#include "app/features/opening/OpenOptionsDialog.h"
#include "app/features/pictures/PingBench.h"
#include "app/features/pictures/Workbench.h"
#include "app/features/settings/PipelinePanel.h"
#include "app/openWindow.h"
#include "app/views/ReportWriter.h"
#include "app/views/WindowViews.h"
#include "app/window/Panels.h"
#include "support/test.h"
#include "widgets/forms/SettingsForm.h"
#include "widgets/pings/PingMap.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QAccessible>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QLayout>
#include <QLineEdit>
#include <QListWidget>
#include <QMenuBar>
#include <QStyleOptionComboBox>
#include <QTabBar>
#include <QToolButton>

#include <set>

using namespace faintline;
using namespace faintline::test;

namespace {

const QByteArray pingsText = R"({"kind": "pings", "pings": 8, "rangeCells": 60, "beams": 8,
                                 "targets": [{"rangeMetres": 3300, "bearingDegrees": 90}]})";
const QByteArray sceneText = R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 20, "lines": []})";

/// What a screen reader says of a widget.
QString spokenName(QWidget *widget)
{
    QAccessibleInterface *interface = QAccessible::queryAccessibleInterface(widget);
    return interface ? interface->text(QAccessible::Name) : widget->accessibleName();
}

/// Whether it is a part of another one that has the name: a spin box's line, a combo box's list, a table's scroll bar.
bool isInner(const QWidget *widget)
{
    if (widget->objectName().startsWith(QLatin1String("qt_")))
        return true;
    const QWidget *parent = widget->parentWidget();
    return (parent
            && (parent->inherits("QAbstractSpinBox") || parent->inherits("QComboBox")
                || widget->inherits("QScrollBar")))
           || widget->inherits("QComboBoxListView") || widget->inherits("QComboBoxPrivateContainer");
}

/// Every layout leaves its pictures 350 pixels of height, and their canvases that width; nothing widens the window.
void lookAtLayouts(MainWindow &window, const QSize &size, const std::vector<WaterfallView *> &views, int canvas)
{
    window.resize(size);
    for (const QString &layout : Panels::layoutNames()) {
        window.findChild<Panels *>()->takeLayout(layout);
        QCoreApplication::processEvents();
        QCOMPARE(window.size(), size);
        for (const WaterfallView *view : views)
            QVERIFY2(view->canvas()->width() >= canvas && view->height() >= 350,
                     qPrintable(layout + QStringLiteral(": %1, %2").arg(view->canvas()->width()).arg(view->height())));
    }
    window.findChild<Panels *>()->takeLayout(Panels::researcher());
}

/// A row of tabs speaks through its tabs; a hidden message has nothing to say yet, nor has a sheet whose panel shows no
/// equation.
bool isSilent(const QWidget *widget)
{
    const bool isEmptyText = widget->inherits("QLabel") || widget->inherits("QToolButton")
                             || widget->objectName() == QLatin1String("equationSheet");
    return widget->inherits("QTabBar") || (isEmptyText && !widget->isVisible());
}

QString describe(const QWidget *widget)
{
    QStringList way;
    for (const QWidget *w = widget; w; w = w->parentWidget())
        way.prepend(w->objectName().isEmpty() ? QString::fromLatin1(w->metaObject()->className()) : w->objectName());
    return way.join('/');
}

/// Focusable widgets without a name.
QStringList nameless(QWidget &root)
{
    QStringList result;
    for (QWidget *widget : root.findChildren<QWidget *>())
        if (widget->focusPolicy() != Qt::NoFocus && !isInner(widget) && !isSilent(widget)
            && spokenName(widget).isEmpty())
            result << describe(widget);
    result.removeDuplicates();
    return result;
}

} // namespace

class tst_Comfort : public WindowTest
{
    Q_OBJECT

private slots:
    void initTestCase() { QVERIFY(open(sceneText, {}, {1280, 800})); }

    void everyWidgetHasAName()
    {
        const QStringList without = nameless(*m_window);
        for (const QString &one : without)
            qWarning("%s", qPrintable(one));
        QVERIFY2(without.isEmpty(), qPrintable(without.join(QStringLiteral("\n"))));
        OpenOptionsDialog opening(m_folder.filePath("scene.json"));
        QVERIFY2(nameless(opening).isEmpty(), qPrintable(nameless(opening).join(QStringLiteral("\n"))));
        InjectDialog inject(m_window->document().recording()->info(), 1.0, 100.0, 0.5);
        QVERIFY2(nameless(inject).isEmpty(), qPrintable(nameless(inject).join(QStringLiteral("\n"))));
    }

    void everyActionSaysWhatItDoes()
    {
        for (QAction *action : m_window->findChildren<QAction *>())
            if (!action->isSeparator() && action->parent() && action->isVisible() && !action->shortcut().isEmpty())
                QVERIFY2(!action->text().isEmpty(), qPrintable(action->shortcut().toString()));
    }

    void noKeyMeansTwoThings()
    {
        QMap<QString, QString> keys;
        QStringList clashes;
        for (const QAction *menu : m_window->menuBar()->actions())
            for (const QAction *action : menu->menu()->actions())
                for (const QKeySequence &key : action->shortcuts()) {
                    if (keys.contains(key.toString()))
                        clashes << key.toString() + ": " + keys[key.toString()] + ", " + action->text();
                    keys.insert(key.toString(), action->text());
                }
        QVERIFY2(clashes.isEmpty(), qPrintable(clashes.join(QStringLiteral("\n"))));
        // Nor do two menus open with one letter.
        std::set<QChar> letters;
        for (const QAction *menu : m_window->menuBar()->actions()) {
            const QChar letter = menu->text()[menu->text().indexOf('&') + 1].toLower();
            QVERIFY2(letters.insert(letter).second, qPrintable(menu->text()));
        }
    }

    void everyPanelIsReachedByTab_data()
    {
        QTest::addColumn<QString>("layout");
        for (const QString &name : Panels::layoutNames())
            QTest::newRow(qPrintable(name)) << name;
    }

    void everyPanelIsReachedByTab()
    {
        QFETCH(QString, layout);
        m_window->findChild<Panels *>()->takeLayout(layout);
        QCoreApplication::processEvents();
        for (const QTabBar *bar :
             m_window->findChildren<QTabBar *>(Qt::FindDirectChildrenOnly)) // an empty one would take others' clicks
            QVERIFY(bar->count() > 1 || !bar->isVisible() || !m_window->rect().intersects(bar->geometry()));
        m_window->activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(m_window.get()));
        std::set<const QDockWidget *> reached;
        bool isCentreReached = false;
        QWidget *first = nullptr;
        for (int i = 0; i < 600; ++i) {
            QTest::keyClick(m_window->focusWidget() ? m_window->focusWidget() : m_window.get(), Qt::Key_Tab);
            QWidget *now = m_window->focusWidget();
            if (!now || (first && now == first))
                break;
            first = first ? first : now;
            for (QWidget *w = now; w; w = w->parentWidget()) {
                if (const auto *dock = qobject_cast<QDockWidget *>(w))
                    reached.insert(dock);
                isCentreReached |= w == m_window->centralWidget();
            }
        }
        QVERIFY(isCentreReached);
        for (const QDockWidget *dock : reached) // not one behind another's tab
            QVERIFY2(!dock->visibleRegion().isEmpty(), qPrintable(dock->windowTitle()));
        for (QDockWidget *dock : m_window->findChildren<QDockWidget *>()) {
            const bool isSeen =
                dock->widget() && dock->widget()->isVisible() && !dock->widget()->visibleRegion().isEmpty();
            bool canHaveFocus = false;
            for (const QWidget *child : dock->widget()->findChildren<QWidget *>())
                canHaveFocus |= (child->focusPolicy() & Qt::TabFocus) && child->isVisible() && child->isEnabled();
            if (isSeen && canHaveFocus)
                QVERIFY2(reached.count(dock), qPrintable(dock->windowTitle()));
        }
    }

    void thePaletteHasEverySetting()
    {
        m_window->activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(m_window.get()));
        auto *palette = m_window->findChild<CommandPalette *>();
        QTest::keyClick(m_window.get(), Qt::Key_K, Qt::ControlModifier);
        QVERIFY(palette->isVisible() && palette->isWindow()); // so that no floating panel covers it
        QStringList entries;
        for (int i = 0; i < palette->list()->count(); ++i)
            entries << palette->list()->item(i)->text();
        int count = 0;
        for (const auto &field : AnalysisSettings::fields()) {
            const QString stage = QString::fromStdString(field.name).section('.', 0, 0);
            const bool isOfPings = stage == "pings" || std::ranges::count(pingFrames().sections, stage) > 0;
            const QString label = QString::fromStdString(labelOf(field));
            if (isOfPings || !field.get(m_window->document().settings()))
                continue;
            ++count;
            const auto isIt = [&](const QString &entry) {
                return entry.startsWith("Setting: ") && entry.endsWith(": " + label);
            };
            QVERIFY2(std::ranges::any_of(entries, isIt), field.name.c_str());
        }
        QCOMPARE(entries.filter(QRegularExpression("^Setting: ")).size(), count);
        QTest::keyClicks(palette->line(), "setting excluded");
        QTest::keyClick(palette->line(), Qt::Key_Escape);
        // The choice of a setting goes to its row, also where that is folded away.
        QTest::keyClick(m_window.get(), Qt::Key_K, Qt::ControlModifier);
        QTest::keyClicks(palette->line(), "Setting: Signal model: Slopes per bin");
        QTest::keyClick(palette->line(), Qt::Key_Return);
        QWidget *editor = m_window->panel<PipelinePanel>().form()->editor("model.slopesPerBin");
        QTRY_VERIFY(editor->hasFocus() && !editor->visibleRegion().isEmpty());
    }

    void noPartOfTheWindowIsShownOnItsOwn()
    {
        class Watch : public QObject
        {
        public:
            bool eventFilter(QObject *watched, QEvent *event) override
            {
                auto *widget = qobject_cast<QWidget *>(watched);
                if (event->type() == QEvent::Show && widget && widget->isWindow()
                    && !qobject_cast<QMainWindow *>(widget))
                    shown << QString("%1 %2 “%3”")
                                 .arg(widget->metaObject()->className(), widget->objectName(),
                                      widget->property("text").toString());
                return false;
            }
            QStringList shown;
        } watch;
        qApp->installEventFilter(&watch);
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, writeFile(m_folder, "alone.json", pingsText)));
        QVERIFY2(watch.shown.isEmpty(), qPrintable(watch.shown.join(", ")));
    }

    void aPanelFromTheMenuIsInFront()
    {
        auto *panels = m_window->findChild<Panels *>();
        panels->takeLayout(Panels::researcher());
        for (const char *name : {"spectrumDock", "compareDock", "evaluateDock"}) {
            auto *dock = m_window->findChild<QDockWidget *>(name);
            dock->toggleViewAction()->trigger();
            QCoreApplication::processEvents();
            QVERIFY2(dock->isVisible() && !dock->visibleRegion().isEmpty(), name);
        }
        panels->takeLayout(Panels::researcher());
    }

    /// Every sheet, from the menu or by its command: a usable height, and pictures of 350 pixels above.
    void sheetsLeaveThePicturesTheirRoom()
    {
        auto *panels = m_window->findChild<Panels *>();
        m_window->resize(1280, 800);
        const Workbench &bench = m_window->workbench();
        for (const QDockWidget *dock : m_window->findChildren<QDockWidget *>()) {
            panels->takeLayout(Panels::researcher());
            QCoreApplication::processEvents();
            if (m_window->dockWidgetArea(const_cast<QDockWidget *>(dock)) != Qt::BottomDockWidgetArea)
                continue;
            dock->toggleViewAction()->trigger();
            QCoreApplication::processEvents();
            QCOMPARE(m_window->size(), QSize(1280, 800));
            QVERIFY2(
                bench.input()->height() >= 350 && bench.output()->height() >= 350 && dock->height() >= 200,
                qPrintable(
                    QString("%1: %2, %3").arg(dock->windowTitle()).arg(bench.input()->height()).arg(dock->height())));
        }
        panels->takeLayout(Panels::researcher());
        for (const char *name : {"compareDock", "sweepDock", "evaluateDock"}) { // the second and third share tabs
            auto *dock = m_window->findChild<QDockWidget *>(name);
            dock->toggleViewAction()->trigger();
            QCoreApplication::processEvents();
            QVERIFY2(bench.input()->height() >= 350 && dock->height() >= 200,
                     qPrintable(QString("%1: %2, %3").arg(name).arg(bench.input()->height()).arg(dock->height())));
        }
        panels->takeLayout(Panels::researcher());
    }

    void aFloatingPanelReturnsToTheFront()
    {
        m_window->findChild<Panels *>()->takeLayout(Panels::researcher());
        auto *dock = m_window->findChild<QDockWidget *>("eventsDock");
        dock->setFloating(true);
        QCoreApplication::processEvents();
        dock->setFloating(false);
        QCoreApplication::processEvents();
        QVERIFY(dock->isVisible() && !dock->visibleRegion().isEmpty());
    }

    void aPanelTakesTheWholeWindowAndGoesBack()
    {
        auto *panels = m_window->findChild<Panels *>();
        panels->takeLayout("Evaluate");
        auto *dock = m_window->findChild<QDockWidget *>("evaluateDock");
        m_window->activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(m_window.get()));
        m_window->workbench().input()->setFocus();
        QTest::keyClick(m_window.get(), Qt::Key_F11);
        QTRY_COMPARE(dock->geometry(), QRect(m_window->mapToGlobal(QPoint()), m_window->size()));
        QVERIFY(dock->isFloating());
        QTest::keyClick(m_window.get(), Qt::Key_F11);
        QVERIFY(!dock->isFloating());
        QTRY_VERIFY(!dock->visibleRegion().isEmpty() && dock->height() < m_window->height() / 2);
        panels->takeLayout(Panels::researcher());
    }

    void picturesHaveTheRoom_data()
    {
        QTest::addColumn<QSize>("size");
        QTest::addColumn<int>("canvas");
        QTest::newRow("1280x800") << QSize(1280, 800) << 350;
        QTest::newRow("1600x1000") << QSize(1600, 1000) << 360;
    }

    void picturesHaveTheRoom()
    {
        QFETCH(QSize, size);
        QFETCH(int, canvas);
        const Workbench &bench = m_window->workbench();
        lookAtLayouts(*m_window, size, {bench.input(), bench.output()}, canvas);
    }

    void mapsHaveTheRoom_data() { picturesHaveTheRoom_data(); }

    void mapsHaveTheRoom()
    {
        QFETCH(QSize, size);
        const auto window = newWindow(size);
        QVERIFY(openAndSettle(*window, writeFile(m_folder, "pings.json", pingsText)));
        const PingBench &bench = window->pingBench();
        lookAtLayouts(*window, size, {bench.input()->plane(), bench.output()->plane()}, 330);
        window->resize(QSize(size.width(), 2000));
        QCoreApplication::processEvents();
        QVERIFY(bench.histories()->isVisible());
    }

    void aSmallScreenIsEnough_data()
    {
        QTest::addColumn<QByteArray>("scene");
        QTest::newRow("lines") << sceneText;
        QTest::newRow("pings") << pingsText;
    }

    void aSmallScreenIsEnough() // 1280 × 800 pixels at twice the size
    {
        QFETCH(QByteArray, scene);
        const QSize room(640, 376); // with the frame of a window manager
        const auto window = newWindow(room);
        window->resize(room); // before, its parts have not yet the window's fonts
        QCoreApplication::processEvents();
        QVERIFY2(window->size() == room,
                 qPrintable(QString("welcome: %1 × %2").arg(window->width()).arg(window->height())));
        QVERIFY(openAndSettle(*window, writeFile(m_folder, "small.json", scene)));
        for (const QString &layout : Panels::layoutNames()) {
            window->findChild<Panels *>()->takeLayout(layout);
            window->resize(room);
            QCoreApplication::processEvents();
            QVERIFY2(window->size() == room,
                     qPrintable(QString("%1: %2 × %3").arg(layout).arg(window->width()).arg(window->height())));
        }
    }

    /// In a window of that size every panel needs no more width than it has.
    void aSmallScreenIsEnoughForEveryPanel()
    {
        const QSize room(640, 376);
        const auto window = newWindow(room);
        QVERIFY(openAndSettle(*window, writeFile(m_folder, "small.json", sceneText)));
        QStringList wider;
        for (QDockWidget *dock : window->findChildren<QDockWidget *>()) {
            if (!dock->widget() || !dock->toggleViewAction()->isVisible())
                continue;
            window->findChild<Panels *>()->takeLayout(Panels::researcher());
            if (dock->isHidden())
                dock->toggleViewAction()->trigger();
            dock->raise();
            window->resize(room);
            QCoreApplication::processEvents();
            QVERIFY2(window->size() == room, qPrintable(dock->windowTitle()));
            const QWidget &panel = *dock->widget();
            const int needed = panel.layout() ? panel.layout()->minimumSize().width() : panel.minimumSizeHint().width();
            if (needed > panel.width())
                wider << QString("%1: %2 of %3").arg(dock->windowTitle()).arg(needed).arg(panel.width());
        }
        QVERIFY2(wider.isEmpty(), qPrintable(wider.join("; ")));
    }

    void toolsSayWhatTheyAre()
    {
        const auto *bar = m_window->findChild<ToolBar *>();
        const auto buttons = [&] {
            QList<QToolButton *> result;
            for (QToolButton *button : bar->findChildren<QToolButton *>())
                if (button->isVisible() && !button->text().isEmpty())
                    result << button;
            return result;
        };
        for (const int width : {1280, 1600}) {
            m_window->resize(width, 800);
            QCoreApplication::processEvents();
            QCOMPARE(buttons().size(), 11); // none has gone where there is no room
            for (const QToolButton *button : buttons()) {
                QVERIFY2(!button->icon().isNull(), qPrintable(button->text()));
                QVERIFY2(!button->toolTip().isEmpty(), qPrintable(button->text()));
                QVERIFY2(button->width() >= button->sizeHint().width(), qPrintable(button->text()));
                if (width == 1600)
                    QCOMPARE(button->toolButtonStyle(), Qt::ToolButtonTextBesideIcon);
            }
        }
    }

    void iconsTakeTheThemesColour()
    {
        const auto darkest = [](const QIcon &icon) {
            const QImage image = icon.pixmap(24).toImage();
            int lightness = 255;
            for (int y = 0; y < image.height(); ++y)
                for (int x = 0; x < image.width(); ++x)
                    if (qAlpha(image.pixel(x, y)) > 200)
                        lightness = std::min(lightness, image.pixelColor(x, y).lightness());
            return lightness;
        };
        const QIcon icon = m_window->findChild<ToolBar *>()->findChildren<QToolButton *>().last()->icon();
        QVERIFY(darkest(icon) < 100);
        for (const Theme::Kind kind : {Theme::Kind::Dark, Theme::Kind::HighContrast}) {
            Theme::apply(kind);
            QVERIFY(darkest(icon) > 180);
        }
        Theme::apply(Theme::Kind::Light);
    }

    void picturesOfAReportAreLightAsItsPage()
    {
        const auto pictures = [this] {
            QList<QImage> images;
            for (const ReportMaterial::Picture &one : reportPictures(m_window->views()))
                images << QImage::fromData(QByteArray::fromStdString(one.png), "PNG");
            return images;
        };
        Theme::apply(Theme::Kind::Light);
        const QList<QImage> light = pictures();
        Theme::apply(Theme::Kind::Dark);
        QCoreApplication::processEvents();
        const QList<QImage> dark = pictures();
        QCOMPARE(dark.size(), light.size());
        for (int i = 0; i < light.size(); ++i)
            QCOMPARE(dark[i].pixel(2, 2), light[i].pixel(2, 2)); // of the ground
        QVERIFY(QColor(dark.last().pixel(2, 2)).lightness() > 200);
        QVERIFY(Theme::kind(QApplication::palette()) == Theme::Kind::Dark);
        Theme::apply(Theme::Kind::Light);
    }

    void nothingInTheFormsIsCut()
    {
        m_window->resize(1280, 800);
        m_window->findChild<Panels *>()->takeDefault();
        auto *dock = m_window->findChild<QDockWidget *>(QStringLiteral("pipelineDock"));
        dock->raise();
        QCoreApplication::processEvents();
        QVERIFY(!dock->widget()->visibleRegion().isEmpty());
        for (const QComboBox *box : dock->findChildren<QComboBox *>()) {
            if (!box->isVisible())
                continue;
            QStyleOptionComboBox option;
            option.initFrom(box);
            const int room =
                box->style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, box).width();
            for (int i = 0; i < box->count(); ++i)
                QVERIFY2(box->fontMetrics().horizontalAdvance(box->itemText(i)) <= room, qPrintable(box->itemText(i)));
        }
        for (const QLabel *label : dock->findChildren<QLabel *>())
            if (label->isVisible() && !label->text().isEmpty() && label->textFormat() != Qt::RichText)
                for (const QString &word : label->text().remove(QLatin1Char('&')).split(QLatin1Char(' ')))
                    QVERIFY2(label->fontMetrics().horizontalAdvance(word) <= label->width(), qPrintable(label->text()));
        for (const QTabBar *tabs : m_window->findChildren<QTabBar *>())
            for (int i = 0; tabs->isVisible() && tabs->parentWidget() == m_window.get() && i < tabs->count(); ++i)
                QVERIFY2(tabs->tabRect(i).width() >= tabs->fontMetrics().horizontalAdvance(tabs->tabText(i)),
                         qPrintable(tabs->tabText(i)));
    }
};

FAINTLINE_WINDOW_TEST(tst_Comfort)

#include "tst_Comfort.moc"
