// Every view has its equation and its keys, and both come up for the view one is at.

#include "app/commands/KeysOverlay.h"
#include "app/commands/keySections.h"
#include "app/features/help/EquationSheet.h"
#include "app/features/help/equations.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "app/views/WindowViews.h"
#include "app/window/currentView.h"
#include "plan/makeDetector.h"
#include "support/test.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/plot/StripPlot.h"

#include <QMenuBar>

using namespace faintline;
using namespace faintline::test;

class tst_equations : public QObject
{
    Q_OBJECT

private slots:
    void everyViewHasOne()
    {
        for (const QString &view : WindowViews::names()) {
            if (view == "window")
                continue;
            const Equation *equation = equationOf(view);
            QVERIFY2(equation, qPrintable(view));
            QVERIFY(!equation->title.isEmpty() && !equation->equation.isEmpty() && !equation->symbols.isEmpty()
                    && !equation->source.isEmpty());
        }
        for (const std::string_view detector : detectorNames)
            QVERIFY2(equationOf("output", QString::fromLatin1(detector.data())), detector.data());
        QVERIFY(equationOf("output", "smd") != equationOf("output", "pOfN"));
        QVERIFY(equationOf("output", "presence"));
        QVERIFY(!equationOf("moon"));
    }

    void everyViewHasItsKeys()
    {
        for (const char *view :
             {"input", "output", "map", "threshold", "events", "pd", "slice", "walk", "histories", "hand", "targets"}) {
            const KeySection section = keysOfView(view);
            QVERIFY2(section.entries.size() >= 2, view);
            QVERIFY(section.title.startsWith("Here"));
        }
        QVERIFY(keysOfView({}).entries.empty());
    }

    void sheetHasTheKeysOfAllCommands()
    {
        const auto window = newWindow();
        QMap<QString, QString> sheet;
        for (const KeySection &section : generalKeys({}, window->menuBar()->actions()))
            for (const auto &[keys, does] : section.entries)
                sheet[does] = keys;
        QCOMPARE(sheet["Next event"], QString("N"));
        QCOMPARE(sheet["Redo"], QString("Ctrl + Y   Ctrl + Shift + Z"));
        QCOMPARE(sheet["Layer over the statistic"], QString("Shift + V"));
        QCOMPARE(sheet["Class"], QString("1 … 9"));
        for (const QAction *menu : window->menuBar()->actions())
            for (const QAction *action : menu->menu()->actions())
                QVERIFY2(action->shortcut().isEmpty() || sheet.contains(plainText(*action)),
                         qPrintable(action->text()));
    }

    void theOneOfTheViewComesUp()
    {
        Theme::apply(Theme::Kind::Light);
        const auto own = newWindow();
        MainWindow &window = *own;
        auto *sheet = window.findChild<EquationSheet *>();
        QVERIFY(currentView(window, window).isEmpty());
        QTest::keyClick(&window, Qt::Key_F1, Qt::ShiftModifier);
        QVERIFY(!sheet->isVisible());

        window.open(":/lessons/scenes/two-near-lines.json");
        QTRY_VERIFY_WITH_TIMEOUT(window.document().analysis() && !window.controller().isBusy(), patience);
        const std::pair<QWidget *, QString> views[] = {{window.workbench().input(), "input"},
                                                       {window.workbench().output(), "output"},
                                                       {&window.thresholdPlot(), "threshold"}};
        for (const auto &[widget, name] : views) {
            widget->setFocus();
            QCOMPARE(currentView(window, window), name);
            QTest::keyClick(widget, Qt::Key_F1, Qt::ShiftModifier);
            QVERIFY(sheet->isVisible());
            QVERIFY2(sheet->text().contains(equationOf(name)->equation), qPrintable(name));
            QTest::keyClick(sheet, Qt::Key_Escape);
            QVERIFY(!sheet->isVisible());
            QVERIFY(widget->hasFocus());
        }

        // Another detector has another equation.
        window.controller().edit("detector.kind", std::string("pOfN"), "Change the detector");
        QTRY_VERIFY_WITH_TIMEOUT(!window.controller().isBusy(), patience);
        window.workbench().output()->setFocus();
        QTest::keyClick(window.workbench().output(), Qt::Key_F1, Qt::ShiftModifier);
        QVERIFY(sheet->text().contains("P largest"));
        QTest::keyClick(sheet, Qt::Key_F1, Qt::ShiftModifier);
        QVERIFY(!sheet->isVisible());
    }
};

FAINTLINE_WINDOW_TEST(tst_equations)
#include "tst_equations.moc"
