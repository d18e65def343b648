// Events are judged in the window: what changes is seen, can be undone, and comes back with the session.

#include "app/features/events/EventReviews.h"
#include "support/test.h"

#include "app/base/filePath.h"
#include "app/features/events/EventFiles.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "exchange/Session.h"
#include "exchange/readAnnotations.h"
#include "exchange/writeEvents.h"
#include "support/find.h"
#include "support/recordings.h"
#include "widgets/events/EventModel.h"
#include "widgets/events/EventTable.h"
#include "widgets/waterfall/WaterfallView.h"

#include <QAction>
#include <QApplication>
#include <QInputDialog>
#include <QListWidget>
#include <QMenu>
#include <QTableView>

using namespace faintline;
using namespace faintline::test;

class tst_EventReviews : public WindowTest
{
    Q_OBJECT

    std::vector<Verdict> verdicts() const
    {
        std::vector<Verdict> result;
        for (const EventReview &one :
             eventReviews(*document().analysis(), document().shownEvents(), document().annotations().reviews))
            result.push_back(one.verdict);
        return result;
    }
    QAction *actionOf(const QString &text) const
    {
        for (QAction *action : m_window->findChildren<QAction *>())
            if (action->text().remove('&') == text)
                return action;
        throw Error(text.toStdString(), "is no action");
    }
    void choose(const std::vector<int> &ids) const
    {
        m_window->eventTable().setSelectedEvent(ids.front());
        QTableView *table = m_window->eventTable().table();
        for (int id : ids)
            for (int row = 0; row < table->model()->rowCount(); ++row)
                if (table->model()->index(row, EventModel::Id).data(EventModel::SortRole).toInt() == id)
                    table->selectionModel()->select(table->model()->index(row, 0),
                                                    QItemSelectionModel::Select | QItemSelectionModel::Rows);
    }

private slots:
    void initTestCase() // opened once: every test leaves it as it was
    {
        QVERIFY(open(R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 60, "lines": [
            {"snrDb": 9, "referenceSeconds": 0.5, "startSeconds": 5, "durationSeconds": 40, "frequencyHz": 120,
            "driftHzPerSecond": 1},
            {"snrDb": 7, "referenceSeconds": 0.5, "startSeconds": 20, "durationSeconds": 30, "frequencyHz": 350}]})",
                     {}, {1440, 900}));
        QVERIFY(document().shownEvents().size() >= 2);
    }
    void cleanup()
    {
        m_window->eventTable().filter()->clear();
        while (document().undoStack().canUndo())
            document().undoStack().undo();
        document().undoStack().clear();
        QVERIFY(settle(*m_window));
    }

    void oneKeyEach()
    {
        choose({1});
        m_window->activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(m_window.get()));
        QTest::keyClick(m_window->eventTable().table(), Qt::Key_X);
        QCOMPARE(verdicts().front(), Verdict::Rejected);
        QCOMPARE(m_window->eventTable().selectedEvent(), 1);
        QTest::keyClick(m_window->eventTable().table(), Qt::Key_Y);
        QCOMPARE(verdicts().front(), Verdict::Accepted);
        QTest::keyClick(m_window->eventTable().table(), Qt::Key_U);
        QVERIFY(document().annotations().isEmpty());
        QCOMPARE(document().undoStack().count(), 3);
        QVERIFY2(!m_window->controller().isBusy(), "nothing is detected anew for it");
        document().undoStack().undo();
        document().undoStack().undo();
        QCOMPARE(verdicts().front(), Verdict::Rejected);
    }

    void digitsGiveClasses()
    {
        auto &table = m_window->eventTable();
        QVERIFY(table.table()->isColumnHidden(EventModel::Class));
        choose({1, 2});
        m_window->activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(m_window.get()));
        QTest::keyClick(table.table(), Qt::Key_3);
        QCOMPARE(document().undoStack().count(), 1);
        QCOMPARE(document().annotations().reviews.front().label, std::string("class 3"));
        QVERIFY(!table.table()->isColumnHidden(EventModel::Class));
        m_window->reviews().setClassNames({"hum", "  two\nlines "});
        QCOMPARE(m_window->reviews().classNames().mid(0, 3), QStringList({"hum", "two lines", "class 3"}));
        choose({2});
        QTest::keyClick(table.table(), Qt::Key_1);
        table.filter()->setText("class=hu");
        QCOMPARE(shownIds(table), std::vector<int>{2});
        table.filter()->setText("class=class3"); // "class 3"
        QCOMPARE(shownIds(table), std::vector<int>{1});
        table.filter()->setText("class=");
        QCOMPARE(shownIds(table).size(), document().shownEvents().size() - 2);
        table.filter()->clear();
        choose({1, 2});
        QTest::keyClick(table.table(), Qt::Key_U, Qt::ShiftModifier);
        QVERIFY(document().annotations().isEmpty());
        QVERIFY(table.table()->isColumnHidden(EventModel::Class));
        m_window->reviews().setClassNames({});
    }

    void aClassIsExported()
    {
        choose({1});
        m_window->reviews().classify("fin whale");
        const QString path = m_folder.filePath("classes.csv");
        m_window->reviews().files().exportTo(path);
        const QList<QByteArray> rows = test::readBytes(path.toStdString()).split('\n');
        QVERIFY2(rows[1].contains(",\"fin whale\","), rows[1].constData());
        QVERIFY2(rows[2].contains(",\"event 2\","), rows[2].constData());
    }

    void linesAreCutAndDrawnByHand()
    {
        choose({1});
        WaterfallView &input = *m_window->workbench().input();
        const std::vector<SignalPath> found = piecesOf({}, *document().analysis(), document().shownEvents().front());
        QCOMPARE(found.size(), std::size_t(1));
        const double middle = 0.5 * (found[0].seconds.front() + found[0].seconds.back());
        document().viewport().setCursor({found[0].seconds.back() + 5.0, 100.0});
        QVERIFY(!actionOf("Cut at the cursor")->isEnabled());
        document().viewport().setCursor({middle, 100.0});
        actionOf("Cut at the cursor")->trigger();
        const auto drawn = [&] { return document().annotations().reviews.front().drawn; };
        QCOMPARE(drawn().size(), std::size_t(2));
        QCOMPARE(drawn()[1].seconds.front(), middle);

        // The end of the first piece is dragged down by 20 Hz and back by 2 s; its other points and the second piece stay.
        actionOf("Draw by hand")->setChecked(true);
        const std::vector<SignalPath> before = drawn();
        const auto at = [&](double seconds, double hz) { return input.positionOf({seconds, hz}).toPoint(); };
        const double hz = before[0].position.back().front();
        const auto grab = at(before[0].seconds[2], before[0].position[2].front());
        const auto drop = at(before[0].seconds[2], before[0].position[2].front() + 20.0);
        QTest::mousePress(input.canvas(), Qt::LeftButton, {}, grab);
        QTest::mouseMove(input.canvas(), drop);
        QVERIFY2(drawn() == before, "one step of editing, when the mouse is released");
        QTest::mouseRelease(input.canvas(), Qt::LeftButton, {}, drop);
        QCOMPARE(drawn().size(), std::size_t(2));
        QVERIFY(std::abs(drawn()[0].position[2].front() - before[0].position[2].front() - 20.0) < 3.0);
        QCOMPARE(drawn()[0].position.back().front(), hz);
        QCOMPARE(drawn()[1], before[1]);
        QCOMPARE(document().undoStack().count(), 2);
        // A click off the line is the picture's.
        QTest::mouseClick(input.canvas(), Qt::LeftButton, {}, at(middle, 300.0));
        QCOMPARE(document().undoStack().count(), 2);
        QVERIFY(std::abs(document().viewport().cursor()->hz - 300.0) < 3.0);
        const QImage withLines = input.grab().toImage();
        actionOf("Draw by hand")->setChecked(false);
        actionOf("As detected")->trigger();
        QVERIFY(document().annotations().isEmpty());
        QVERIFY(input.grab().toImage() != withLines);
    }

    void aRejectedEventIsFaintAndCanBeFilteredOut()
    {
        const auto seen = [this] {
            choose({2}); // what is selected is bright
            return m_window->workbench().output()->grab().toImage();
        };
        const QImage before = seen();
        choose({1});
        const auto all = shownIds(m_window->eventTable()).size();
        m_window->reviews().judge(Verdict::Rejected);
        QVERIFY(seen() != before);
        QCOMPARE(shownIds(m_window->eventTable()).size(), all);
        m_window->eventTable().filter()->setText("!rejected");
        QCOMPARE(shownIds(m_window->eventTable()).size(), all - 1);
        m_window->eventTable().filter()->setText("rejected");
        QCOMPARE(shownIds(m_window->eventTable()), std::vector<int>{1});
        document().undoStack().undo();
        QCOMPARE(shownIds(m_window->eventTable()).size(), std::size_t(0));
    }

    void aNoteIsWritten()
    {
        choose({2});
        QTimer::singleShot(0, this, [] {
            auto *dialog = qobject_cast<QInputDialog *>(QApplication::activeModalWidget());
            QVERIFY(dialog);
            dialog->setTextValue("yes");
            dialog->accept();
        });
        emit m_window->eventTable().noteRequested();
        QCOMPARE(document().annotations().reviews.front().note, std::string("yes"));
        m_window->reviews().setNote(77, "of an event that is gone");
        QCOMPARE(document().undoStack().count(), 1);
    }

    void severalAreMerged()
    {
        choose({1, 2});
        m_window->reviews().merge();
        QCOMPARE(document().annotations().reviews.size(), std::size_t(1));
        m_window->reviews().judge(Verdict::Rejected);
        QCOMPARE(verdicts()[1], Verdict::Rejected);
        m_window->reviews().separate();
        QCOMPARE(document().annotations().reviews.size(), std::size_t(2));
        for (int i = 0; i < 3; ++i)
            document().undoStack().undo();
        QVERIFY(document().annotations().isEmpty());
    }

    void aMeasuredBoxIsNamed()
    {
        const QImage before = m_window->workbench().input()->grab().toImage();
        m_window->reviews().annotateSelection("nothing is measured");
        QVERIFY(document().annotations().isEmpty());
        document().viewport().setSelection({{10.0, 20.0}, {100.0, 200.0}});
        m_window->reviews().annotateSelection("pump");
        QCOMPARE(document().annotations().boxes.size(), std::size_t(1));
        QVERIFY((document().annotations().boxes.front()
                 == Annotation{10.0, 20.0, 100.0, 200.0, "pump", "", Verdict::None}));
        QVERIFY(m_window->workbench().input()->grab().toImage() != before);
        document().undoStack().undo();
        QVERIFY(document().annotations().isEmpty());
    }

    void outAndInAgain()
    {
        choose({1});
        m_window->reviews().judge(Verdict::Rejected);
        const QString file = m_folder.filePath("out.selections.txt");
        m_window->reviews().files().exportTo(file);
        const Json provenance = readJsonFile(file.toStdString() + ".provenance.json");
        QVERIFY(provenance["recording"].contains("scenario"));
        QCOMPARE(provenance["annotations"]["reviews"].size(), std::size_t(1));
        QVERIFY(!provenance["version"].get<std::string>().empty());
        const auto events = document().shownEvents().size();
        const auto boxes = readAnnotations(file.toStdString(), document().recording()->info());
        QCOMPARE(boxes.size(), events);
        m_window->reviews().files().importFrom(file);
        // What is judged in it judges here, the rest are boxes.
        QCOMPARE(document().annotations().boxes.size(), events - 1);
        QCOMPARE(verdicts().front(), Verdict::Rejected);
        document().undoStack().undo();
        QCOMPARE(document().annotations().boxes.size(), std::size_t(0));
        document().undoStack().undo(); // what was judged by hand
        QCOMPARE(verdicts().front(), Verdict::None);
        m_window->reviews().files().importFrom(file);
        QCOMPARE(verdicts().front(), Verdict::Rejected);
        document().undoStack().undo();
        QVERIFY(document().annotations().boxes.empty());
        QFile bad(m_folder.filePath("bad.txt"));
        QVERIFY(bad.open(QIODevice::WriteOnly));
        bad.write("no table");
        bad.close();
        QVERIFY_EXCEPTION_THROWN(m_window->reviews().files().importFrom(bad.fileName()), Error);
    }

    void anExportIsMadeAgainWithoutTheWindow()
    {
        choose({1});
        m_window->reviews().judge(Verdict::Rejected);
        m_window->reviews().setNote(1, "a fan");
        document().viewport().setSelection({{10.0, 20.0}, {100.0, 200.0}});
        m_window->reviews().annotateSelection("pump");
        m_window->controller().edit("decide.falseAlarmsPerHour", FieldValue(3.0), "Change");
        QVERIFY(settle(*m_window));
        const auto replay = [&](const QString &name, QByteArray *error = nullptr) {
            QProcess process;
            process.setWorkingDirectory(m_folder.path());
            process.start(QStringLiteral(FAINTLINE_BINARY_DIR "/app/faintline-cli"), {"replay", name});
            if (!process.waitForFinished(patience))
                return QByteArray("did not end");
            if (error)
                *error = process.readAllStandardError();
            return process.readAllStandardOutput();
        };
        for (const QString &name : {QString("r.csv"), QString("r.json"), QString("r.selections.txt"), QString("r.txt"),
                                    QString("r.sigmf-meta")}) {
            m_window->reviews().files().exportTo(m_folder.filePath(name));
            QCOMPARE(replay(name), name.toUtf8() + ": the same bytes\n");
        }
        m_window->reviews().files().exportTracksTo(m_folder.filePath("tracks.csv"));
        QCOMPARE(replay("tracks.csv"), QByteArray("tracks.csv: the same bytes\n"));
        writeTracks(*document().analysis(), pathBytes(m_folder.filePath("all.csv")));
        const auto bytesOf = [&](const char *name) {
            QFile table(m_folder.filePath(name));
            return table.open(QIODevice::ReadOnly) ? table.readAll() : QByteArray("not there");
        };
        QCOMPARE(bytesOf("tracks.csv"), bytesOf("all.csv"));
        // One digit of another makes a difference.
        QFile file(m_folder.filePath("r.csv"));
        QVERIFY(file.open(QIODevice::Append));
        file.write("0");
        file.close();
        QByteArray error;
        QCOMPARE(replay("r.csv", &error), QByteArray("r.csv: differs\n"));
        QVERIFY2(error.startsWith("error: ") && error.count('\n') == 1, error.constData());
        // A picture tells of its making, but another program makes it.
        QVERIFY(replay("shot.png", &error).isEmpty());
        QVERIFY2(error.contains("faintline replay") && error.count('\n') == 1, error.constData());
    }

    void aRightClickSelectsInAllViews()
    {
        const WaterfallView *views[]{m_window->workbench().input(), m_window->workbench().output()};
        const auto isSelected = [&](int id) {
            return m_window->eventTable().selectedEvent() == id
                   && std::ranges::all_of(views,
                                          [&](const WaterfallView *view) { return view->selectedEvent() == id; });
        };
        const Event second = document().shownEvents()[1];
        for (WaterfallView *view : {m_window->workbench().input(), m_window->workbench().output()}) {
            choose({document().shownEvents()[0].id});
            QMenu menu;
            emit view->contextMenuRequested(&menu, 0.5 * (second.onsetSeconds + second.endSeconds),
                                            second.position.front());
            QVERIFY(isSelected(second.id));
            QVERIFY(std::ranges::any_of(menu.actions(),
                                        [](const QAction *action) { return action->shortcut() == Qt::Key_X; }));
        }
        QTableView &table = *m_window->eventTable().table();
        const auto ids = shownIds(m_window->eventTable());
        const auto row = int(std::ranges::find(ids, document().shownEvents()[0].id) - ids.begin());
        QTest::mousePress(table.viewport(), Qt::RightButton, {},
                          table.visualRect(table.model()->index(row, 1)).center());
        QVERIFY(isSelected(document().shownEvents()[0].id));
    }

    void theSelectionIsOfTheView()
    {
        const int second = document().shownEvents()[1].id;
        choose({second});
        const ViewState kept = viewFromJson(toJson(m_window->viewState()), "s.faintline");
        choose({document().shownEvents()[0].id});
        m_window->restore(kept);
        QCOMPARE(m_window->eventTable().selectedEvent(), second);
        QCOMPARE(m_window->workbench().output()->selectedEvent(), second);
        for (const int gone : {-3, 9999}) { // as other settings leave it
            ViewState stale = kept;
            stale.selectedEvent = gone;
            m_window->restore(stale);
            QCOMPARE(m_window->workbench().output()->selectedEvent(), second);
        }
    }

    void survivesAnotherThresholdAndTheSession()
    {
        choose({1});
        m_window->reviews().judge(Verdict::Accepted);
        m_window->reviews().setNote(1, "a fan\nin the next room");
        m_window->reviews().judge(Verdict::Accepted);
        QCOMPARE(document().undoStack().count(), 2);
        m_window->controller().commitThreshold(document().analysis()->threshold - 1.5);
        QVERIFY(settle(*m_window));
        const auto said =
            eventReviews(*document().analysis(), document().shownEvents(), document().annotations().reviews);
        const auto found = std::find_if(said.begin(), said.end(),
                                        [](const EventReview &one) { return one.verdict == Verdict::Accepted; });
        QVERIFY(found != said.end());
        QCOMPARE(found->note, std::string("a fan in the next room"));

        const QString session = m_folder.filePath("s.faintline");
        writeSession(pathBytes(session),
                     {document().source(), {}, document().settings(), Json::object(), document().annotations()});
        const Annotations kept = document().annotations();
        document().undoStack().setClean();
        m_window->open(session);
        QVERIFY(settle(*m_window));
        QVERIFY(document().annotations() == kept);
        QVERIFY(!document().isModified());
    }

    void whatMatchesNoEventIsListed()
    {
        auto *list = m_window->eventTable().findChild<QListWidget *>();
        choose({1});
        m_window->reviews().judge(Verdict::Rejected);
        m_window->reviews().setNote(1, "a fan");
        QVERIFY(!list->isVisible());
        m_window->controller().previewThreshold(1e6); // above every event
        QCOMPARE(shownIds(m_window->eventTable()).size(), std::size_t(0));
        QVERIFY(list->isVisible());
        QCOMPARE(list->count(), 1);
        const QString line = list->item(0)->text();
        QVERIFY2(line.startsWith("rejected, ") && line.endsWith(" Hz: a fan"), qPrintable(line));
        document().viewport().clearCursor();
        emit list->itemClicked(list->item(0));
        QVERIFY(document().viewport().cursor());
        const double hz = document().annotations().reviews.front().paths.front().position.front().front();
        QCOMPARE(document().viewport().cursor()->hz, hz);
        QCOMPARE(document().annotations().reviews.size(), std::size_t(1)); // kept
        m_window->controller().previewThreshold(document().analysis()->threshold);
        QVERIFY(!list->isVisible());
        QCOMPARE(verdicts().front(), Verdict::Rejected);
    }
};

FAINTLINE_WINDOW_TEST(tst_EventReviews)

#include "tst_EventReviews.moc"
