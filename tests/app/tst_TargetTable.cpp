// Targets of a sonar scene in a table: two-way with the map, typed numbers, bad input, keys.

#include "app/TargetsTest.h"
#include "support/test.h"

#include <qwt_plot_canvas.h>

#include <QComboBox>

using namespace faintline;
using namespace faintline::test;

class tst_TargetTable : public TargetsTest
{
    Q_OBJECT

private slots:
    void initTestCase() { writeScene(); }
    void init() { openScene(); }
    void cleanup() { m_window.reset(); }

    void theTableAndTheMapShowTheSame()
    {
        QCOMPARE(table().model()->rowCount(), 1);
        QCOMPARE(cell(0, TargetColumn::Target), QString("T1"));
        QCOMPARE(cell(0, TargetColumn::Snr), QString("11"));
        QCOMPARE(cell(0, TargetColumn::From), QString("5"));
        QCOMPARE(cell(0, TargetColumn::Until), QString("end"));
        QCOMPARE(cell(0, TargetColumn::Pings), QString("12"));
        QCOMPARE(cell(0, TargetColumn::RangeRate), QString("0.5"));
        const auto title = [this](TargetColumn column) {
            return table().model()->headerData(int(column), Qt::Horizontal).toString();
        };
        QCOMPARE(title(TargetColumn::RangeRate), QString("Range rate (cells/ping)"));
        auto *unit = panel().findChild<QComboBox *>();
        unit->setCurrentIndex(0);
        emit unit->activated(0);
        QCOMPARE(title(TargetColumn::RangeRate), QString("Range rate (m/s)"));
        QCOMPARE(cell(0, TargetColumn::RangeRate), QString("0.125")); // 5 m in 40 s
        // The table follows a drag before the mouse is released.
        startPlacing();
        QTest::mousePress(canvas(), Qt::LeftButton, {}, at(3300.0, 45.0));
        QTest::mouseMove(canvas(), at(3600.0, 45.0));
        QCOMPARE(table().model()->rowCount(), 2);
        QVERIFY(!cell(1, TargetColumn::RangeRate).isEmpty());
        QTest::mouseRelease(canvas(), Qt::LeftButton, {}, at(3600.0, 45.0));
        QCOMPARE(table().currentIndex().row(), 1);
        // A selected row selects the corner.
        table().setCurrentIndex(table().model()->index(0, int(TargetColumn::RangeRate)));
        QCOMPARE(panel().editor().selected(), (TargetHandle{0, 1}));
    }

    void typedNumbersChangeTheScene()
    {
        type(0, TargetColumn::Snr, "14.5");
        QCOMPARE(scene().targets[0].snrDb, 14.5);
        type(0, TargetColumn::Range, "3333");
        QCOMPARE(scene().targets[0].rangeMetres, 3333.0);
        type(0, TargetColumn::From, "1");
        QCOMPARE(scene().targets[0].appearPing, 0);
        type(0, TargetColumn::Until, "20");
        QCOMPARE(scene().targets[0].vanishPing, 20); // the 20th ping is the last one with it
        type(0, TargetColumn::Pings, "end");
        QCOMPARE(scene().targets[0].legs[0].pings, 0);
        type(0, TargetColumn::RangeRate, "-1.25");
        QCOMPARE(scene().targets[0].legs[0].rangeCellsPerPing, -1.25);
        type(0, TargetColumn::BearingRate, "0.1");
        QCOMPARE(scene().targets[0].legs[0].beamsPerPing, 0.1);
        type(0, TargetColumn::Turn, "3");
        QCOMPARE(scene().targets[0].legs[0].turnPings, 3);
        QCOMPARE(m_window->document().undoStack().count(), 8);
        type(0, TargetColumn::Snr, "14.5"); // the same again is no change
        QCOMPARE(m_window->document().undoStack().count(), 8);
        QCOMPARE(cell(0, TargetColumn::Fluctuation), QString("none"));
        for (const char *text : {"3", "Swerling 3", "swerling3"}) {
            type(0, TargetColumn::Fluctuation, "none");
            QVERIFY(scene().targets[0].fluctuation == Fluctuation::None);
            type(0, TargetColumn::Fluctuation, text);
            QVERIFY(scene().targets[0].fluctuation == Fluctuation::Swerling3);
            QCOMPARE(cell(0, TargetColumn::Fluctuation), QString("Swerling 3"));
        }
    }

    void badInputGivesOneLine_data()
    {
        QTest::addColumn<int>("column");
        QTest::addColumn<QString>("typed");
        QTest::addColumn<QString>("line");
        QTest::newRow("no number") << int(TargetColumn::Snr) << "loud"
                                   << "Target T1, SNR = loud: must lie in -60 … 80 dB";
        QTest::newRow("no case of Swerling's")
            << int(TargetColumn::Fluctuation) << "5"
            << "Target T1, fluctuation = swerling5: must be one of none, swerling1, swerling2, swerling3, swerling4";
        QTest::newRow("off the map") << int(TargetColumn::Range) << "9000"
                                     << "Target T1, range = 9000: must lie in 3000 … 4190 m";
        QTest::newRow("after the end") << int(TargetColumn::From) << "25"
                                       << "Target T1, from ping = 25: must lie in 1 … 24, a whole number";
        QTest::newRow("before it appears") << int(TargetColumn::Until) << "3"
                                           << "Target T1, until ping = 3: must lie in 5 … 24, a whole number";
        QTest::newRow("half a ping") << int(TargetColumn::Pings) << "2.5"
                                     << "Target T1, leg 1, pings = 2.5: must lie in 1 … 24, a whole number";
        QTest::newRow("too fast") << int(TargetColumn::RangeRate) << "1e9"
                                  << "Target T1, leg 1, range rate = 1e+09: must lie in -10000 … 10000 cells/ping";
    }

    void badInputGivesOneLine()
    {
        QFETCH(int, column);
        QFETCH(QString, typed);
        QFETCH(QString, line);
        const PingScene before = scene();
        type(0, TargetColumn(column), typed);
        QCOMPARE(sentenceOf(panel()), line);
        QVERIFY(scene() == before);
        QCOMPARE(m_window->document().undoStack().count(), 0);
        type(0, TargetColumn::Snr, "12"); // a good number takes the line away
        QVERIFY(sentenceOf(panel()) != line);
    }

    void everythingIsReachedByKeyboard()
    {
        PingViewports::Place cursor = bench().viewports().place();
        cursor.position[0] = 3500.0;
        cursor.position[1] = 180.0;
        bench().viewports().setPlace(cursor);
        buttonOf(panel(), "Target at cursor")->setFocus();
        QTest::keyClick(buttonOf(panel(), "Target at cursor"), Qt::Key_Space);
        QCOMPARE(scene().targets.size(), std::size_t(2));
        QCOMPARE(last().rangeMetres, 3500.0);
        cursor.position[0] = 3600.0;
        bench().viewports().setPlace(cursor);
        buttonOf(panel(), "Leg to cursor")->setFocus();
        QTest::keyClick(buttonOf(panel(), "Leg to cursor"), Qt::Key_Space);
        QCOMPARE(last().legs.size(), std::size_t(1));
        QCOMPARE(last().legs[0].rangeCellsPerPing, 0.5); // 10 cells in 20 pings
        // Digits typed on the table begin to edit; they are not the window's keys for classes.
        ColumnTable &table = this->table();
        table.setFocus();
        table.setCurrentIndex(table.model()->index(1, int(TargetColumn::Snr)));
        QTest::keyClick(&table, Qt::Key_9);
        auto *edit = table.findChild<QLineEdit *>();
        QVERIFY(edit);
        QTest::keyClick(edit, Qt::Key_Return);
        QCoreApplication::processEvents();
        QCOMPARE(last().snrDb, 9.0);
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        table.setCurrentIndex(table.model()->index(1, int(TargetColumn::Pings)));
        QTest::keyClick(&table, Qt::Key_Delete);
        QVERIFY(last().legs.empty());
        table.setCurrentIndex(table.model()->index(1, int(TargetColumn::Snr)));
        QTest::keyClick(&table, Qt::Key_Delete);
        QCOMPARE(scene().targets.size(), std::size_t(1));
    }

    /// By any column, as other tables, and then its cells are still those of their targets.
    void isSortedAndCopiedCellByCell()
    {
        PingViewports::Place cursor = bench().viewports().place();
        cursor.position = {3400.0, 60.0};
        bench().viewports().setPlace(cursor);
        QTest::mouseClick(buttonOf(panel(), "Target at cursor"), Qt::LeftButton);
        type(1, TargetColumn::Snr, "9");
        QCOMPARE(cell(0, TargetColumn::Snr), "11");
        table().sortByColumn(int(TargetColumn::Snr), Qt::AscendingOrder);
        QCOMPARE(cell(0, TargetColumn::Snr), "9"); // and not 11 before 9, as texts
        type(0, TargetColumn::Range, "3500");
        QCOMPARE(last().rangeMetres, 3500.0);
        QCOMPARE(cell(0, TargetColumn::Range), "3500");
        table().setCurrentIndex(table().model()->index(1, int(TargetColumn::Snr)));
        table().actions().front()->trigger();
        QCOMPARE(QGuiApplication::clipboard()->text(), "11");
        QTest::keyClick(&table(), Qt::Key_Delete);
        QCOMPARE(scene().targets.size(), std::size_t(1));
        QCOMPARE(last().snrDb, 9.0);
    }
};

FAINTLINE_WINDOW_TEST(tst_TargetTable)
#include "tst_TargetTable.moc"
