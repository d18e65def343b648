#include "support/test.h"
#include "widgets/events/EventTable.h"

#include "pictures.h"
#include "pixels.h"
#include "support/find.h"
#include "widgets/base/Theme.h"
#include "widgets/events/EventCard.h"
#include "widgets/events/EventFilter.h"
#include "widgets/events/EventModel.h"

#include <QAction>
#include <QHeaderView>
#include <QLineEdit>
#include <QSignalSpy>
#include <QTableView>
#include <QTextDocumentFragment>
#include <QToolButton>

using namespace faintline;

/// Events as a table.
class tst_EventTable : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void init()
    {
        m_activated.clear();
        m_table = std::make_unique<EventTable>();
        std::vector<Event> events{test::event(1, 5.0, 20.0, 950.0, 31.0), test::event(2, 100.0, 120.0, 1200.0, 9.5),
                                  test::event(3, 40.0, 90.0, 300.0, 101.0)};
        events[1].isConfirmed = false;
        events[2].isOpen = true;
        m_table->setEvents(events);
        connect(m_table.get(), &EventTable::eventActivated, this, [this](int id) { m_activated.push_back(id); });
        test::show(*m_table, {700, 250});
    }

    void sortsByValueNotByText()
    {
        QCOMPARE(test::shownIds(*m_table), (std::vector<int>{1, 3, 2})); // by onset
        m_table->table()->sortByColumn(EventModel::Statistic, Qt::AscendingOrder);
        QCOMPARE(test::shownIds(*m_table), (std::vector<int>{2, 1, 3})); // 9.5, 31, 101
        m_table->table()->sortByColumn(EventModel::Frequency, Qt::DescendingOrder);
        QCOMPARE(test::shownIds(*m_table), (std::vector<int>{2, 1, 3}));
    }

    void newResultsDoNotReorderTheList()
    {
        // Event 1 begins later now, event 2 is gone, and a new one begins between the others.
        m_table->setEvents(
            {test::event(1, 50.0, 60.0, 950.0), test::event(3, 40.0, 90.0, 300.0), test::event(4, 20.0, 30.0, 500.0)});
        QCOMPARE(test::shownIds(*m_table), (std::vector<int>{1, 4, 3}));
        const QHeaderView &header = *m_table->table()->horizontalHeader();
        const QPoint onset(header.sectionViewportPosition(EventModel::Onset) + 4, header.height() / 2);
        QTest::mouseClick(header.viewport(), Qt::LeftButton, {}, onset);
        QCOMPARE(test::shownIds(*m_table), (std::vector<int>{1, 3, 4})); // from the latest on
        m_table->setEvents({});                                          // another recording
        m_table->setEvents({test::event(1, 1.0, 2.0, 950.0), test::event(3, 9.0, 10.0, 300.0)});
        QCOMPARE(test::shownIds(*m_table), (std::vector<int>{3, 1}));
    }

    void aNarrowPanelShowsWhereAndSinceWhen()
    {
        m_table->resize(280, 250);
        QCoreApplication::processEvents();
        const QTableView &table = *m_table->table();
        for (const int column : {EventModel::Id, EventModel::Frequency, EventModel::Snr, EventModel::Onset}) {
            const int right = table.columnViewportPosition(column) + table.columnWidth(column);
            QVERIFY2(right <= table.viewport()->width(),
                     qPrintable(QStringLiteral("%1: %2 of %3").arg(column).arg(right).arg(table.viewport()->width())));
        }
    }

    /// On a screen of 1280 pixels the panel has 280: frequency, SNR and onset are seen.
    void onASmallScreenNothingNeedsScrolling()
    {
        const auto isSeen = [&](const std::vector<int> &columns) {
            const QTableView &table = *m_table->table();
            for (const int column : columns)
                if (table.columnViewportPosition(column) + table.columnWidth(column) > table.viewport()->width())
                    return false;
            return true;
        };
        const std::vector<int> times{EventModel::Id, EventModel::Frequency, EventModel::Snr, EventModel::Onset};
        for (const double since : {90.0, 4321.5}) {
            m_table->setEvents({});
            m_table->setEvents({test::event(1, since, since + 20.0, 960.03, 21.6),
                                test::event(2, since + 42.8, since + 49.5, since < 1000.0 ? 1053.0 : 20151.0)});
            m_table->resize(280, 200);
            QCoreApplication::processEvents();
            QVERIFY(isSeen(times));
            for (const int column : times) { // headings are whole, too
                const QHeaderView &header = *m_table->table()->horizontalHeader();
                const QString heading = m_table->table()->model()->headerData(column, Qt::Horizontal).toString();
                QVERIFY2(header.fontMetrics().horizontalAdvance(heading) + 4 <= m_table->table()->columnWidth(column),
                         qPrintable(heading));
            }
        }
    }

    void onASmallScreenPingsNeedNoScrolling()
    {
        std::vector<Event> events{test::event(1, 75.0, 300.0, 0.0, 165.0), test::event(2, 30.0, 500.0, 0.0, 210.0)};
        events[0].position = {10460.0, 270.0};
        events[1].position = {5720.0, 72.0};
        m_table->setEvents({});
        m_table->setScales(
            {.axes = {{"range", "m", 1000.0, 10.0, 2500, false}, {"bearing", "°", 0.0, 18.0, 20, true}}});
        m_table->setEvents(events);
        m_table->resize(280, 200);
        QCoreApplication::processEvents();
        const QTableView &table = *m_table->table();
        for (const int column : {EventModel::Frequency, EventModel::Bearing, EventModel::Onset, EventModel::Detection,
                                 EventModel::Confirmation}) {
            const int right = table.columnViewportPosition(column) + table.columnWidth(column);
            QVERIFY2(right <= table.viewport()->width(), qPrintable(QString("%1: %2").arg(column).arg(right)));
        }
    }

    void aCardTellsAllOfTheSelectedEvent()
    {
        Event event = test::event(7, 5.0, 20.0, 950.0);
        event.snrDb = 12.34;
        event.driftPerSecond = -0.5;
        event.noiseProbability = 3e-6;
        event.windowSeconds = 0.25;
        m_table->setEvents({event, test::event(8, 50.0, 60.0, 100.0)});
        m_table->setSnrUnit("dB in 2500 Hz");
        m_table->setScales({.startUnixSeconds = 1.7e9});
        EventReview classified;
        classified.event = 7;
        classified.label = "a <whale>";
        m_table->setReviews({classified});
        m_table->resize(420, 420);
        QAction why("Why");
        QSignalSpy asked(&why, &QAction::triggered);
        m_table->card().setActions({&why});
        QVERIFY(m_table->card().isHidden());
        m_table->setSelectedEvent(7);
        QVERIFY(m_table->card().isVisible());
        QString text = QTextDocumentFragment::fromHtml(m_table->card().text()).toPlainText();
        text.replace(QChar::Nbsp, QLatin1Char(' '));
        for (const char *fact :
             {"Event 7", "Frequency 950.00 Hz", "SNR 12.3 dB in 2500 Hz", "Time 5.0 … 20.0 s", "Drift −0.5 Hz/s",
              "Window 0.25 s", "Onset 2023-11-14", "Chance of noise 3·10", "Class a <whale>"})
            QVERIFY2(text.contains(QString::fromUtf8(fact)), qPrintable(text));
        QTest::mouseClick(m_table->card().findChild<QToolButton *>(), Qt::LeftButton);
        QCOMPARE(asked.count(), 1);
        m_table->resize(420, 200); // the list needs the room
        QVERIFY(m_table->card().isHidden());
    }

    void numbersAreNotCutShort()
    {
        m_table->setEvents(
            {test::event(1, 5.0, 20.0, 20150.25, 31.0), test::event(2, 40000.0, 90000.0, -23999.5, 123456.7)});
        EventReview accepted; // has a mark before its number
        accepted.event = 2;
        accepted.verdict = Verdict::Accepted;
        m_table->setReviews({accepted});
        QCOMPARE(m_table->table()->model()->index(1, EventModel::Id).data().toString(), QString("✓ 2"));
        const QTableView &table = *m_table->table();
        for (int row = 0; row < 2; ++row)
            for (int column = 0; column <= EventModel::Drift; ++column) {
                const QModelIndex index = table.model()->index(row, column);
                if (!table.isColumnHidden(column))
                    QVERIFY2(table.fontMetrics().horizontalAdvance(index.data().toString()) + 6
                                 <= table.columnWidth(column),
                             qPrintable(index.data().toString()));
            }
    }

    void filters()
    {
        const auto shown = [&](const QString &text) {
            m_table->filter()->setText(text);
            return test::shownIds(*m_table);
        };
        QCOMPARE(shown("f>500"), (std::vector<int>{1, 2}));
        QCOMPARE(shown("f>500 stat>=31"), (std::vector<int>{1}));
        QCOMPARE(shown("open"), (std::vector<int>{3}));
        QCOMPARE(shown("tent"), (std::vector<int>{2}));
        QCOMPARE(shown("dur≤20"), (std::vector<int>{1, 2}));
        QCOMPARE(shown(""), (std::vector<int>{1, 3, 2}));
        QCOMPARE(shown("stat>"), (std::vector<int>{1, 3, 2})); // still being typed
        QCOMPARE(EventFilter("f>500 what").misunderstood(), QString("what"));
        QCOMPARE(EventFilter("id=3").misunderstood(), QString());
    }

    void nextAndPreviousGoRound()
    {
        for (int i = 0; i < 4; ++i)
            QTest::keyClick(m_table.get(), Qt::Key_N);
        QTest::keyClick(m_table->table(), Qt::Key_N, Qt::ShiftModifier);
        QCOMPARE(m_activated, (std::vector<int>{1, 3, 2, 1, 2}));
        m_table->filter()->setText("f<1000");
        m_activated.clear();
        m_table->selectNext();
        m_table->selectNext();
        m_table->selectNext();
        QCOMPARE(m_activated, (std::vector<int>{1, 3, 1}));
    }

    void selectionSurvivesNewEvents()
    {
        m_table->setSelectedEvent(3);
        m_table->setEvents({test::event(3, 40.0, 90.0, 300.0), test::event(4, 1.0, 2.0, 100.0)});
        QCOMPARE(m_table->selectedEvent(), 3);
        m_table->setEvents({test::event(4, 1.0, 2.0, 100.0)});
        QCOMPARE(m_table->selectedEvent(), 0);
        m_table->setEvents({});
        m_table->selectNext();
        QVERIFY(m_activated.empty());
    }

    void aSelectionIsAnnouncedOnceWhateverTookIt()
    {
        const QSignalSpy announced(m_table.get(), &EventTable::selectionChanged);
        const QTableView *table = m_table->table();
        QTest::mouseClick(table->viewport(), Qt::LeftButton, {},
                          table->visualRect(table->model()->index(1, EventModel::Onset)).center());
        QCOMPARE(m_table->selectedEvent(), 3);
        QCOMPARE(announced.size(), 1);
        m_table->setSelectedEvent(3);
        QCOMPARE(announced.size(), 1);
        m_table->filter()->setText("f>1000"); // hides it
        QCOMPARE(m_table->selectedEvent(), 0);
        QCOMPARE(announced.size(), 2);
        m_table->filter()->clear();
        m_table->setSelectedEvent(2);
        QCOMPARE(announced.size(), 3);
        m_table->setEvents({test::event(1, 5.0, 20.0, 950.0)});
        QCOMPARE(announced.size(), 4);
    }

    void selectingFromOutsideIsSilent()
    {
        m_table->setSelectedEvent(2);
        QCOMPARE(m_table->selectedEvent(), 2);
        m_table->setSelectedEvent(99);
        QCOMPARE(m_table->selectedEvent(), 0);
        QVERIFY(m_activated.empty());
    }

    void clickAndEnterActivate()
    {
        const QTableView *table = m_table->table();
        QTest::mouseClick(table->viewport(), Qt::LeftButton, {},
                          table->visualRect(table->model()->index(1, EventModel::Onset)).center());
        QCOMPARE(m_activated, (std::vector<int>{3}));
        QTest::keyClick(m_table->table(), Qt::Key_Return);
        QCOMPARE(m_activated, (std::vector<int>{3, 3}));
    }

    void dateAndRadioFrequencyWhereTheyAreKnown()
    {
        const QTableView &table = *m_table->table();
        QVERIFY(table.isColumnHidden(EventModel::Utc));
        QVERIFY(table.isColumnHidden(EventModel::Radio));
        m_table->setScales({.startUnixSeconds = 1721952000.0, .centreHz = 2.5e6});
        QVERIFY(!table.isColumnHidden(EventModel::Utc));
        QVERIFY(!table.isColumnHidden(EventModel::Radio));
        m_table->setScales({});
        QVERIFY(table.isColumnHidden(EventModel::Utc));
    }

    void windowsWhereTheyDiffer()
    {
        std::vector<Event> events{test::event(1, 1.0, 2.0, 100.0), test::event(2, 1.5, 3.0, 200.0)};
        m_table->setEvents(events);
        QVERIFY(m_table->table()->isColumnHidden(EventModel::Window));
        events[0].windowSeconds = events[1].windowSeconds = 0.5;
        m_table->setEvents(events);
        QVERIFY(m_table->table()->isColumnHidden(EventModel::Window));
        events[1].windowSeconds = 2.0;
        m_table->setEvents(events);
        QVERIFY(!m_table->table()->isColumnHidden(EventModel::Window));
        m_table->setEvents({});
        QVERIFY(m_table->table()->isColumnHidden(EventModel::Window));
    }

    void kindsWhereNotAllAreLines()
    {
        std::vector<Event> events{test::event(1, 1.0, 2.0, 100.0), test::event(2, 1.5, 3.0, 200.0)};
        events[0].kind = events[1].kind = SignalKind::Line;
        m_table->setEvents(events);
        QVERIFY(m_table->table()->isColumnHidden(EventModel::Kind));
        events[1].kind = SignalKind::Keyed;
        m_table->setEvents(events);
        QVERIFY(!m_table->table()->isColumnHidden(EventModel::Kind));
        m_table->setSelectedEvent(2);
        QVERIFY(m_table->card().text().startsWith("Event 2, keyed"));
    }

    void callsWhereThereAreSome()
    {
        std::vector<Event> events{test::event(1, 1.0, 2.0, 100.0), test::event(2, 1.5, 3.0, 200.0),
                                  test::event(3, 1.5, 3.0, 400.0)};
        m_table->setEvents(events);
        QVERIFY(m_table->table()->isColumnHidden(EventModel::Call));
        events[1].call = events[2].call = 3;
        m_table->setEvents(events);
        QVERIFY(!m_table->table()->isColumnHidden(EventModel::Call));
        const auto cell = [&](int row) {
            return m_table->table()->model()->index(row, EventModel::Call).data().toString();
        };
        QCOMPARE(cell(0), QString());
        QCOMPARE(cell(1), QString("3"));
        m_table->setSelectedEvent(2);
        QVERIFY(m_table->card().text().contains("Call"));
        m_table->setSelectedEvent(1);
        QVERIFY(!m_table->card().text().contains("Call"));
    }

private:
    std::unique_ptr<EventTable> m_table;
    std::vector<int> m_activated;
};

FAINTLINE_WINDOW_TEST(tst_EventTable)
#include "tst_EventTable.moc"
