// A survey in the window: one table of all events, from which recordings are opened at an event and reviewed.

#include "app/features/survey/SurveyPanel.h"
#include "support/test.h"

#include "app/features/pictures/Workbench.h"
#include "app/features/survey/SurveyModel.h"
#include "app/openWindow.h"
#include "exchange/survey/SurveyDatabase.h"
#include "exchange/survey/carryOutSurvey.h"
#include "exchange/writeEvents.h"
#include "scene/SimulatedRecording.h"
#include "signal/formats/writeRecording.h"
#include "support/lines.h"
#include "support/recordings.h"
#include "widgets/base/Theme.h"
#include "widgets/events/EventTable.h"

#include <QPushButton>
#include <QTableView>

#include <filesystem>

using namespace faintline;
using namespace faintline::test;

class tst_SurveyPanel : public WindowTest
{
    Q_OBJECT

    SurveySettings m_settings;

    std::string path(const char *name) const { return m_folder.filePath(name).toStdString(); }
    SurveyPanel &panel() const { return m_window->panel<SurveyPanel>(); }
    QTableView &table() const { return *panel().table(); }
    QString text(int row, int column) const { return table().model()->index(row, column).data().toString(); }
    bool openSurvey(const char *name) const
    {
        QSignalSpy opened(&panel(), &SurveyPanel::opened);
        m_window->open(m_folder.filePath(name));
        return opened.wait(patience);
    }
    void simulate(const char *name, double frequencyHz) const
    {
        LineScene simulated = scene(1000.0, 30.0, 1);
        simulated.lines = {line(frequencyHz, 0.0, 5.0, 20.0, 9.0, 0.5)};
        // As another program does: this one replaces no recording that its window shows.
        writeRecording(SimulatedRecording(simulated), path("made.wav"));
        std::filesystem::rename(path("made.wav"), path(name));
    }

private slots:
    void initTestCase()
    {
        simulate("a.wav", 120.0);
        simulate("b.wav", 240.0);
        writeBytes(path("c.wav"), "no sound");
        m_settings.analysis.spectrogram.windowSeconds = 0.5;
        m_settings.analysis.decide.falseAlarmsPerHour = 2.0;
        carryOutSurvey({m_settings, {path("a.wav"), path("b.wav"), path("c.wav")}, {}, 2}, path("s.sqlite"));
        m_window = newWindow({1440, 900});
        QVERIFY(openSurvey("s.sqlite"));
    }

    void knowsSurveysByTheirHeader()
    {
        std::filesystem::copy(path("s.sqlite"), path("named.otherwise"));
        QVERIFY(SurveyPanel::isSurvey(m_folder.filePath("named.otherwise")));
        QVERIFY(!SurveyPanel::isSurvey(m_folder.filePath("a.wav")));
        QVERIFY(!SurveyPanel::isSurvey(m_folder.filePath("none.wav")));
    }

    void isATableOfAllEvents()
    {
        QVERIFY(panel().isVisible());
        QVERIFY(table().model()->rowCount() >= 2);
        table().sortByColumn(SurveyModel::Frequency, Qt::AscendingOrder);
        QCOMPARE(text(0, SurveyModel::Recording), QStringLiteral("a.wav"));
        table().sortByColumn(SurveyModel::Recording, Qt::DescendingOrder);
        QCOMPARE(text(0, SurveyModel::Recording), QStringLiteral("b.wav"));
        QVERIFY(m_window->windowTitle().startsWith("Survey"));
    }

    void whatIsSelectedStaysSo()
    {
        table().sortByColumn(SurveyModel::Recording, Qt::AscendingOrder);
        table().selectRow(0);
        table().sortByColumn(SurveyModel::Recording, Qt::DescendingOrder);
        const QModelIndexList selected = table().selectionModel()->selectedRows();
        QCOMPARE(selected.size(), 1);
        QVERIFY(selected.front().row() > 0);
        QCOMPARE(selected.front().data().toString(), QStringLiteral("a.wav"));
        for (int column = 0; column < SurveyModel::ColumnCount; ++column) {
            table().sortByColumn(column, Qt::AscendingOrder);
            const QModelIndexList one = table().selectionModel()->selectedRows();
            QCOMPARE(one.size(), 1);
            QCOMPARE(one.front().data().toString(), QStringLiteral("a.wav"));
        }
    }

    void anEventOpensItsRecording()
    {
        table().sortByColumn(SurveyModel::Recording, Qt::DescendingOrder);
        QSignalSpy reached(&panel(), &SurveyPanel::eventReached);
        emit table().activated(table().model()->index(0, 0));
        QTRY_COMPARE_WITH_TIMEOUT(reached.count(), 1, patience);
        QCOMPARE(m_window->document().sourcePath(), m_folder.filePath("b.wav"));
        QVERIFY(m_window->document().settings() == m_settings.analysis);
        QCOMPARE(m_window->eventTable().selectedEvent(), reached.front().front().toInt());
        QVERIFY(m_window->workbench().isVisible() && panel().isVisible());
        // The window finds to the last bit what the survey has found.
        const std::vector<Event> shown = m_window->document().shownEvents();
        const std::vector<SurveyEvent> kept = SurveyDatabase(path("s.sqlite")).events(2);
        QCOMPARE(shown.size(), kept.size());
        for (std::size_t i = 0; i < shown.size(); ++i)
            QCOMPARE(eventsCsv(*m_window->document().analysis(), {kept[i].event}),
                     eventsCsv(*m_window->document().analysis(), {shown[i]}));
        m_window->eventTable().setSelectedEvent(0);
        emit table().activated(table().model()->index(0, 0)); // it is open already
        QCOMPARE(reached.count(), 2);
        QVERIFY(!m_window->controller().isBusy());
        const auto last = table().model()->rowCount() - 1;
        emit table().activated(table().model()->index(last, 0));
        QTRY_COMPARE_WITH_TIMEOUT(reached.count(), 3, patience);
        QCOMPARE(m_window->document().sourcePath(), m_folder.filePath("a.wav"));
    }

    void reviewsAreWrittenToTheFile()
    {
        table().sortByColumn(SurveyModel::Recording, Qt::AscendingOrder);
        table().selectRow(0);
        m_window->activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(m_window.get()));
        table().setFocus();
        QTest::keyClick(&table(), Qt::Key_X);
        QCOMPARE(text(0, SurveyModel::Review), QStringLiteral("rejected"));
        QVERIFY(m_window->document().annotations().isEmpty()); // the recording's own reviews are not meant
        const auto stored = [&] { return SurveyDatabase(path("s.sqlite")).events(1).front().box.verdict; };
        QCOMPARE(stored(), Verdict::Rejected);
        QVERIFY(openSurvey("s.sqlite"));
        QCOMPARE(text(0, SurveyModel::Review), QStringLiteral("rejected"));
        table().selectRow(0);
        QTest::keyClick(&table(), Qt::Key_U);
        QCOMPARE(stored(), Verdict::None);
    }

    void reviewsFollowTheirEvents()
    {
        table().sortByColumn(SurveyModel::Recording, Qt::AscendingOrder);
        simulate("0.wav", 60.0); // a.wav becomes the second
        carryOutSurvey({m_settings, {path("0.wav"), path("a.wav"), path("b.wav"), path("c.wav")}, {}, 2},
                       path("s.sqlite"));
        table().selectRow(0);
        panel().judge(Verdict::Accepted);
        SurveyDatabase survey(path("s.sqlite"));
        QCOMPARE(survey.recordings()[1].file.path, path("a.wav"));
        QCOMPARE(survey.events(2).front().box.verdict, Verdict::Accepted);
        QCOMPARE(survey.connection().integer("SELECT count(*) FROM reviews"), std::int64_t(1));
        // Analysed anew, the recording has other events: none of them is reviewed by mistake.
        simulate("a.wav", 130.0);
        carryOutSurvey({m_settings, {path("a.wav")}, {}, 2}, path("s.sqlite"));
        QSignalSpy failed(&panel(), &SurveyPanel::failed);
        panel().judge(Verdict::Rejected);
        QCOMPARE(failed.count(), 1);
        QCOMPARE(SurveyDatabase(path("s.sqlite")).connection().integer("SELECT count(*) FROM reviews"),
                 std::int64_t(0));
        QVERIFY(openSurvey("s.sqlite"));
    }

    void anEventThatCannotBeReachedIsForgotten()
    {
        const QString recording = m_folder.filePath(text(0, SurveyModel::Recording));
        QSignalSpy reached(&panel(), &SurveyPanel::eventReached);
        QVERIFY(QFile::rename(recording, recording + ".away"));
        emit table().activated(table().model()->index(0, 0));
        QVERIFY(settle(*m_window));
        QVERIFY(QFile::rename(recording + ".away", recording));
        QVERIFY(openAndSettle(*m_window, recording));
        QCOMPARE(m_window->document().sourcePath(), recording);
        QVERIFY(m_window->document().analysis());
        QCOMPARE(reached.count(), 0);
    }

    void whatIsNoSurveyIsRefused()
    {
        const int rows = table().model()->rowCount();
        writeBytes(path("x.sqlite"), QByteArray("no database").repeated(1000));
        std::string said;
        const QObject context;
        connect(&panel(), &SurveyPanel::failed, &context, [&](const Error &error) { said = error.what(); });
        m_window->open(m_folder.filePath("x.sqlite"));
        QTRY_VERIFY_WITH_TIMEOUT(!said.empty(), patience);
        QVERIFY(contains(said, "is not an SQLite database"));
        QCOMPARE(table().model()->rowCount(), rows);
    }
};

FAINTLINE_WINDOW_TEST(tst_SurveyPanel)
#include "tst_SurveyPanel.moc"
