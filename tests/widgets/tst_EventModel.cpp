#include "support/test.h"
#include "widgets/events/EventModel.h"

#include "analyse/columns.h"
#include "pictures.h"
#include "widgets/base/Theme.h"

#include <limits>

using namespace faintline;

/// Events as rows: what each column says, what it sorts by, and what is heard of it.
class tst_EventModel : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }
    void init() { m_model = std::make_unique<EventModel>(); }

    void itKeepsTheRulesOfModels()
    {
        const QAbstractItemModelTester tester(m_model.get(), QAbstractItemModelTester::FailureReportingMode::QtTest);
        m_model->setEvents({test::event(1, 5.0, 20.0, 950.0), test::event(2, 1.0, 2.0, 300.0)});
        m_model->setReviews({{2, Verdict::Rejected, "hum", 1}});
        m_model->setScales({.axes = {{"range", "m", 0.0, 10.0, 50, false}, {"bearing", "°", 0.0, 45.0, 8, true}}});
        m_model->setEvents({});
        QCOMPARE(m_model->rowCount(), 0);
        QCOMPARE(m_model->columnCount(), int(EventModel::ColumnCount));
        QVERIFY(!m_model->data({}).isValid());
        QVERIFY(!m_model->headerData(EventModel::ColumnCount, Qt::Horizontal).isValid());
        QVERIFY(!m_model->headerData(-1, Qt::Horizontal).isValid());
    }

    void textsOfAnEvent()
    {
        Event event = test::event(12, 3600.0, 3700.25, 14095.6);
        event.driftPerSecond = -0.0125;
        event.isOpen = true;
        m_model->setEvents({event});
        QCOMPARE(text(EventModel::Id), QString("12"));
        QCOMPARE(text(EventModel::Onset), QString("1:00:00"));
        QCOMPARE(m_model->index(0, EventModel::End).data(Qt::ToolTipRole).toString(), QString("1:01:40.25"));
        QCOMPARE(text(EventModel::Frequency), QString("14095.60"));
        QCOMPARE(text(EventModel::Drift), QString("−0.0125"));
        QCOMPARE(text(EventModel::State), QString("confirmed, open"));
        QCOMPARE(text(EventModel::Utc), QString());
        event.isConfirmed = event.isOpen = false;
        event.snrDb = -12.34;
        event.windowSeconds = 0.125;
        m_model->setEvents({event});
        QCOMPARE(text(EventModel::State), QString("tentative"));
        QCOMPARE(text(EventModel::Snr), QString("−12.3"));
        QCOMPARE(text(EventModel::Window), QString("0.125"));
        event.confirmSeconds = 3600.75;
        event.onsetSeconds = 12.34;
        m_model->setEvents({event});
        QCOMPARE(text(EventModel::Confirmation), QString("1:00:01"));
        m_model->setScales({.startUnixSeconds = 1721952000.0, .centreHz = 2.5e6});
        QVERIFY(m_model->hasUtc() && m_model->hasRadio());
        QCOMPARE(text(EventModel::Utc), QString("2024-07-26T00:00:12.3Z"));
        QCOMPARE(text(EventModel::Radio), QString("2514095.60"));
    }

    void timesHaveTheDigitsTheRecordingNeeds_data()
    {
        QTest::addColumn<double>("end");
        QTest::addColumn<QString>("onset");
        QTest::newRow("a whistle") << 2.5 << QString("1.2346");
        QTest::newRow("a call") << 25.0 << QString("1.23");
        QTest::newRow("a watch") << 250.0 << QString("1.2");
    }

    void timesHaveTheDigitsTheRecordingNeeds()
    {
        QFETCH(double, end);
        QFETCH(QString, onset);
        m_model->setEvents({test::event(1, 1.23456, 1.5, 300.0), test::event(2, 1.5, end, 300.0)});
        QCOMPARE(text(EventModel::Onset), onset);
    }

    void timesOfAColumnHaveOneForm()
    {
        m_model->setEvents({test::event(1, 392.0, 395.0, 100.0), test::event(2, 600.0, 700.0, 100.0)});
        QCOMPARE(text(EventModel::Onset), QString("0:06:32"));
        QCOMPARE(text(EventModel::End, 1), QString("0:11:40"));
        m_model->setEvents({test::event(1, 392.0, 395.0, 100.0)});
        QCOMPARE(text(EventModel::Onset), QString("392.0"));
    }

    void whatIsNotKnownIsADash()
    {
        Event event = test::event(1, 1.0, 2.0, 300.0);
        event.position.clear();
        event.confirmSeconds = event.snrDb = event.windowSeconds = event.noiseProbability =
            std::numeric_limits<double>::quiet_NaN();
        m_model->setEvents({event});
        for (const int column : {EventModel::Frequency, EventModel::Bearing, EventModel::Confirmation, EventModel::Snr,
                                 EventModel::Chance, EventModel::Window})
            QCOMPARE(text(column), QString("–"));
        m_model->setScales({.startUnixSeconds = 0.0, .centreHz = 1e6});
        QCOMPARE(text(EventModel::Radio), QString());
    }

    void theUnknownHasNoKey()
    {
        Event known = test::event(1, 1.0, 2.0, 300.0), unknown = test::event(2, 1.0, 2.0, 300.0);
        known.confirmSeconds = 1e6;
        known.snrDb = -80.0;
        unknown.confirmSeconds = unknown.snrDb = std::numeric_limits<double>::quiet_NaN();
        m_model->setEvents({known, unknown});
        for (const int column : {EventModel::Confirmation, EventModel::Snr}) {
            QVERIFY(std::isfinite(sortValue(column, 0)));
            QVERIFY(std::isnan(sortValue(column, 1)));
        }
    }

    void everyColumnSortsByItsNumber()
    {
        Event weak = test::event(2, 10.0, 30.0, 950.0, 9.5), strong = test::event(10, 100.0, 300.0, 20000.0, 101.0);
        weak.confirmSeconds = 15.0;
        strong.confirmSeconds = 150.0;
        weak.snrDb = -9.0;
        strong.snrDb = 10.0;
        weak.noiseProbability = 1e-9;
        strong.noiseProbability = 0.01;
        weak.windowSeconds = 0.5;
        strong.windowSeconds = 16.0;
        weak.kind = SignalKind::Line;
        strong.kind = SignalKind::Spread;
        weak.call = 2;
        strong.call = 10;
        weak.driftPerSecond = -3.0;
        strong.driftPerSecond = -0.02;
        weak.isConfirmed = true;
        strong.isConfirmed = false;
        m_model->setEvents({weak, strong});
        m_model->setReviews({{2, Verdict::Accepted, "line", 2, "a"}, {10, Verdict::Rejected, {}, 10}});
        for (int column = 0; column < EventModel::ColumnCount; ++column)
            QVERIFY2(sortValue(column, 0) < sortValue(column, 1), qPrintable(heading(column)));
    }

    void reviewsAreMarkedAndSaid()
    {
        m_model->setEvents(
            {test::event(1, 1.0, 2.0, 300.0), test::event(2, 1.0, 2.0, 300.0), test::event(3, 1.0, 2.0, 3.0)});
        QSignalSpy changed(m_model.get(), &EventModel::dataChanged);
        m_model->setReviews({{2, Verdict::Rejected, "hum", 1}, {1, Verdict::Accepted, {}, 1}});
        QCOMPARE(changed.count(), 1);
        QCOMPARE(text(EventModel::Id, 0), QString("✓ 1"));
        QCOMPARE(text(EventModel::Id, 1), QString("× 2"));
        QCOMPARE(text(EventModel::Id, 2), QString("3"));
        QCOMPARE(text(EventModel::Judged, 0), QString("accepted"));
        QCOMPARE(text(EventModel::Judged, 1), QString("rejected, part of 1"));
        QCOMPARE(text(EventModel::Judged, 2), QString());
        QCOMPARE(text(EventModel::Note, 1), QString("hum"));
        QCOMPARE(EventModel::reviewText({5, Verdict::None, {}, 4}), QString("part of 4"));
    }

    void classesAreSaidAndSorted()
    {
        m_model->setEvents(
            {test::event(1, 1.0, 2.0, 300.0), test::event(2, 1.0, 2.0, 300.0), test::event(3, 1.0, 2.0, 3.0)});
        QVERIFY(!m_model->hasClasses());
        m_model->setReviews(
            {{1, Verdict::None, {}, 1}, {2, Verdict::None, {}, 2, "whale"}, {3, Verdict::None, {}, 3, "ship"}});
        QVERIFY(m_model->hasClasses());
        QCOMPARE(text(EventModel::Class, 0), QString());
        QCOMPARE(text(EventModel::Class, 1), QString("whale"));
        const auto place = [&](int row) {
            return m_model->index(row, EventModel::Class).data(EventModel::SortRole).toDouble();
        };
        QVERIFY(place(2) < place(1) && place(1) < place(0)); // ship, whale, none
    }

    void rejectedRowsAreFaint()
    {
        m_model->setEvents({test::event(1, 1.0, 2.0, 300.0), test::event(2, 1.0, 2.0, 300.0)});
        m_model->setReviews({{2, Verdict::Rejected, {}, 2}});
        QVERIFY(!m_model->index(0, EventModel::Onset).data(Qt::ForegroundRole).isValid());
        QCOMPARE(m_model->index(1, EventModel::Onset).data(Qt::ForegroundRole).value<QBrush>().color(),
                 QGuiApplication::palette().color(QPalette::PlaceholderText));
    }

    void reviewsOfOtherEventsAreIgnored()
    {
        m_model->setEvents({test::event(1, 1.0, 2.0, 300.0)});
        m_model->setReviews({{7, Verdict::Rejected, "hum", 7}});
        QCOMPARE(text(EventModel::Id), QString("1"));
        QCOMPARE(text(EventModel::Judged), QString());
        m_model->setEvents({test::event(7, 1.0, 2.0, 300.0)}); // it stays known until others come
        QCOMPARE(text(EventModel::Id), QString("× 7"));
    }

    void hostileNotesStayOnOneLine()
    {
        m_model->setEvents({test::event(1, 1.0, 2.0, 300.0)});
        m_model->setReviews({{1, Verdict::None, "<b>two</b>\nlines\u202e" + std::string(100000, 'x'), 1}});
        const QString note = text(EventModel::Note);
        QVERIFY(note.size() <= 400);
        QVERIFY(note.startsWith("<b>two</b>")); // a table shows it letter by letter
        QVERIFY(!note.contains(QLatin1Char('\n')) && !note.contains(QChar(0x202e)));
        const QString tip = m_model->index(0, EventModel::Note).data(Qt::ToolTipRole).toString();
        QVERIFY2(tip.contains("&lt;b&gt;two"), qPrintable(tip.left(60))); // a tool tip would take it for HTML
    }

    void ofPingsRangeAndBearing()
    {
        Event event = test::event(1, 1.0, 2.0, 0.0);
        event.position = {1250.0, 45.0};
        event.ratesPerSecond = {-2.5, 0.125};
        m_model->setEvents({event});
        QVERIFY(!m_model->hasBearing());
        QSignalSpy headings(m_model.get(), &EventModel::headerDataChanged);
        m_model->setScales({.axes = {{"range", "m", 1000.0, 10.0, 50, false}, {"bearing", "°", 0.0, 45.0, 8, true}}});
        QCOMPARE(headings.count(), 1);
        QVERIFY(m_model->hasBearing());
        QCOMPARE(heading(EventModel::Frequency), QString("R (m)"));
        QCOMPARE(heading(EventModel::Bearing), QString("B (°)"));
        const auto said = [&](int column) {
            return m_model->headerData(column, Qt::Horizontal, Qt::AccessibleTextRole).toString();
        };
        QCOMPARE(said(EventModel::Frequency), QString("Range (m)"));
        QCOMPARE(said(EventModel::Bearing), QString("Bearing (°)"));
        QCOMPARE(heading(EventModel::Drift), QString("Rate (m/s)"));
        QCOMPARE(text(EventModel::Frequency), QString("1250")); // cells are 10 m
        QCOMPARE(text(EventModel::Bearing), QString("45.0"));
        QCOMPARE(text(EventModel::Drift), QString("−2.5"));
        QCOMPARE(sortValue(EventModel::Frequency), 1250.0);
        QCOMPARE(sortValue(EventModel::Bearing), 45.0);
    }

    void aColumnForEachAxis()
    {
        Event event = test::event(1, 1.0, 2.0, 0.0);
        event.position = {1250.0, 45.0, 6.0, -30.0};
        event.ratesPerSecond = {-2.5, 0.125, 0.0, 0.0};
        m_model->setEvents({event});
        m_model->setScales({.axes = {{"range", "m", 0.0, 10.0, 100, false},
                                     {"bearing", "°", 0.0, 3.0, 8, false},
                                     {"elevation", "°", 0.0, 3.0, 4, false},
                                     {"Doppler", "m/s", -50.0, 20.0, 6, false}}});
        const auto heading = [&](int column) { return m_model->headerData(column, Qt::Horizontal, Qt::DisplayRole); };
        QCOMPARE(heading(EventModel::Bearing).toString(), QString::fromUtf8("Bearing (°)"));
        QCOMPARE(heading(EventModel::FourthAxis).toString(), QString("Doppler (m/s)"));
        QCOMPARE(text(EventModel::Bearing), QString("45.0"));
        QCOMPARE(text(EventModel::ThirdAxis), QString("6.0"));
        QCOMPARE(text(EventModel::FourthAxis), QString::fromUtf8("−30.0"));
        QVERIFY(m_model->hasColumn(EventModel::FourthAxis));
        m_model->setScales({.axes = {Axis::unnamed(1, 50), Axis::unnamed(2, 8)}});
        QCOMPARE(heading(EventModel::Frequency).toString(), QString("Axis 1"));
        QCOMPARE(heading(EventModel::Bearing).toString(), QString("Axis 2"));
        m_model->setScales({.axes = {{"frequency", "Hz", 0.0, 1.0, 100, false}}});
        QVERIFY(!m_model->hasColumn(EventModel::Bearing) && !m_model->hasColumn(EventModel::ThirdAxis));
    }

    void unitsFollowTheStatistic()
    {
        QCOMPARE(heading(EventModel::Statistic), QString("D (nat)"));
        QSignalSpy headings(m_model.get(), &EventModel::headerDataChanged);
        m_model->setScales({.statisticUnit = "× noise"});
        QCOMPARE(heading(EventModel::Statistic), QString("D (× noise)"));
        QCOMPARE(headings.count(), 1);
    }

    void windowsAreToldWhereTheyDiffer()
    {
        QVERIFY(!m_model->hasWindows());
        Event one = test::event(1, 1.0, 2.0, 300.0), other = test::event(2, 1.0, 2.0, 300.0);
        one.windowSeconds = other.windowSeconds = 0.5;
        m_model->setEvents({one, other});
        QVERIFY(!m_model->hasWindows());
        other.windowSeconds = 4.0;
        m_model->setEvents({one, other});
        QVERIFY(m_model->hasWindows());
    }

    void everyCellCanBeHeard()
    {
        m_model->setEvents({test::event(1, 1.5, 40.0, 300.0)});
        for (int column = 0; column < EventModel::ColumnCount; ++column) {
            QVERIFY(!heading(column).isEmpty());
            QVERIFY(!m_model->headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString().isEmpty());
            QCOMPARE(m_model->index(0, column).data(Qt::AccessibleTextRole).toString(),
                     heading(column) + ": " + text(column));
        }
        QVERIFY(!m_model->headerData(0, Qt::Vertical).isValid());
    }

    void headingsAreThoseOfTheColumnsOfFiles()
    {
        m_model->setScales({.axes = {{"frequency", "Hz", 0.0, 1.0, 100, false}}});
        QMap<QString, QString> tips;
        for (int column = 0; column < EventModel::ColumnCount; ++column)
            tips[heading(column)] = m_model->headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString();
        for (const TableColumn<Event> &column : eventColumns(Grid(), {.secondPass = true})) {
            if (column.heading.empty())
                continue;
            const QString name = QString::fromStdString(column.heading);
            const QString whole = QStringLiteral("%1 (%2)").arg(name, QString::fromStdString(column.unit));
            const QString tip = tips.contains(whole) ? tips[whole] : tips.value(name);
            QVERIFY2(tip.startsWith(QString::fromStdString(column.sentence)), column.name.c_str());
        }
        QVERIFY(tips.contains("f (Hz)") && tips.contains("SNR (dB)"));
    }

    void rowsAreFoundByNumber()
    {
        m_model->setEvents({test::event(5, 1.0, 2.0, 300.0), test::event(3, 1.0, 2.0, 300.0)});
        QCOMPARE(m_model->rowOf(3), 1);
        QCOMPARE(m_model->rowOf(5), 0);
        QCOMPARE(m_model->rowOf(4), -1);
    }

private:
    QString text(int column, int row = 0) const { return m_model->index(row, column).data().toString(); }
    QString heading(int column) const { return m_model->headerData(column, Qt::Horizontal).toString(); }
    double sortValue(int column, int row = 0) const
    {
        return m_model->index(row, column).data(EventModel::SortRole).toDouble();
    }

    std::unique_ptr<EventModel> m_model;
};

FAINTLINE_WINDOW_TEST(tst_EventModel)
#include "tst_EventModel.moc"
