// Commands found by letters of their names and carried out from the keyboard alone.

#include "app/commands/CommandPalette.h"
#include "support/test.h"

#include <QLineEdit>
#include <QListWidget>
#include <QMenu>

using namespace faintline;

class tst_CommandPalette : public QObject
{
    Q_OBJECT

private slots:
    void letters_data()
    {
        QTest::addColumn<QString>("typed");
        QTest::addColumn<bool>("fits");
        QTest::newRow("nothing") << "" << true;
        QTest::newRow("beginnings") << "nofi" << true;
        QTest::newRow("other case") << "NOISE" << true;
        QTest::newRow("wrong order") << "finoise" << false;
        QTest::newRow("too many") << "noise fits" << false;
    }

    void letters()
    {
        QFETCH(QString, typed);
        QFETCH(bool, fits);
        QCOMPARE(CommandPalette::match("Noise fit", typed) >= 0, fits);
        QVERIFY(CommandPalette::match("Noise fit", "nf") > CommandPalette::match("Confirm", "nf"));
        QVERIFY(CommandPalette::match("Setting: Signal model: Lowest slope", "slope")
                > CommandPalette::match("Setting: Family of lines: Present", "slope"));
        QVERIFY(CommandPalette::match("Show all", "show all") > CommandPalette::match("Sort how alleles", "show all"));
    }

    void whatWasChosenIsDone()
    {
        QWidget window;
        window.resize(800, 600);
        CommandPalette palette(&window);
        QMenu view("&View");
        int first = 0;
        int second = 0;
        int inside = 0;
        view.addAction("Show &all", [&] { ++first; });
        view.addAction("Show some…", [&] { ++second; });
        view.addMenu("&Panels")->addAction("Threshold", [&] { ++inside; });
        window.show();
        palette.open({view.menuAction()});
        QVERIFY(palette.isVisible());
        QCOMPARE(palette.list()->count(), 3);
        QTest::keyClicks(palette.line(), "show");
        QTest::keyClick(palette.line(), Qt::Key_Down);
        QTest::keyClick(palette.line(), Qt::Key_Return);
        QCOMPARE(first, 0);
        QCOMPARE(second, 1);
        QVERIFY(!palette.isVisible());
        palette.open({view.menuAction()});
        QTest::keyClicks(palette.line(), "pt");
        QTest::keyClick(palette.line(), Qt::Key_Return);
        QCOMPARE(inside, 1);
        palette.open({view.menuAction()});
        QTest::keyClick(palette.line(), Qt::Key_Escape);
        QVERIFY(!palette.isVisible());
        QCOMPARE(second, 1);
    }

    /// What has no other words stands before what has; before anything is typed, commands stand as in the menus.
    void theShortestNameIsFirst()
    {
        QWidget window;
        window.show();
        CommandPalette palette(&window);
        QMenu file("&File");
        file.addMenu("Export picture")->addAction("Sweep");
        QMenu view("&View");
        view.addAction("Sweep");
        palette.open({file.menuAction(), view.menuAction()});
        QCOMPARE(palette.list()->item(0)->text(), QString("File: Export picture: Sweep"));
        QTest::keyClicks(palette.line(), "sweep");
        QCOMPARE(palette.list()->item(0)->text(), QString("View: Sweep"));
    }

    void whatCannotBeDoneIsNotOffered()
    {
        QWidget window;
        window.show();
        CommandPalette palette(&window);
        QMenu view("&View");
        view.addAction("Stop")->setEnabled(false);
        view.addSeparator();
        palette.open({view.menuAction()});
        QCOMPARE(palette.list()->count(), 0);
        QTest::keyClick(palette.line(), Qt::Key_Return);
        QVERIFY(palette.isVisible());
    }
};

FAINTLINE_WINDOW_TEST(tst_CommandPalette)
#include "tst_CommandPalette.moc"
