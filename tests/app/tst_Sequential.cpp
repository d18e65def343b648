// Sequential tests from outside: a radar's scans and a recording's view are tested, looked into, cancelled and saved.

#include "app/base/MessageBar.h"
#include "app/document/saveView.h"
#include "app/document/scanScenario.h"
#include "app/features/opening/Card.h"
#include "app/features/opening/WelcomePage.h"
#include "app/features/pictures/Workbench.h"
#include "app/features/sequential/SequentialPanel.h"
#include "app/features/sequential/TrajectoryPage.h"
#include "app/features/sequential/sequentialSentences.h"
#include "app/openWindow.h"
#include "support/test.h"
#include "widgets/plot/BarPlot.h"
#include "widgets/plot/CellPicture.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/plot/WalkPlot.h"

#include <QComboBox>
#include <QDockWidget>
#include <QImage>
#include <QLineEdit>
#include <QMenuBar>
#include <QPushButton>
#include <QSlider>
#include <QTabWidget>

#include <memory>

using namespace faintline;
using namespace faintline::test;

namespace {

ScanTest smallTest()
{
    ScanTest test;
    test.sprt = {0.01, 0.01, 15};
    test.scene.azimuthCells = 2;
    test.scene.elevationCells = 1;
    test.scene.rangeCells = 20;
    test.scene.dopplerCells = 4;
    test.scene.snrDb = test.designSnrDb = 9.0;
    test.walks = 15;
    test.trials = 40;
    test.sectors = 6;
    test.targetSectors = 1;
    test.rounds = 3;
    return test;
}

} // namespace

class tst_Sequential : public WindowTest
{
    Q_OBJECT

private slots:
    void init() { m_window = newWindow(); }

    void cleanup() { m_window.reset(); }

    void theWelcomeCardOpensTheDock()
    {
        const auto cards = m_window->welcome().findChildren<Card *>();
        const auto found =
            std::ranges::find_if(cards, [](const Card *card) { return card->scenario().path == radarScenarioPath(); });
        QVERIFY(found != cards.end());
        Card *card = *found;
        QVERIFY(card->isVisible());
        QVERIFY(dock()->isHidden());
        QTest::mouseClick(card, Qt::LeftButton);
        QVERIFY(dock()->isVisible());
        QVERIFY(!m_window->welcome().isVisible());
        QVERIFY(QTest::qWaitFor([this] { return !tests().isEmpty(); }, patience));
        QVERIFY(tests().test() == readScanTest(radarScenarioPath()));
        QVERIFY(dock()->height() > m_window->height() / 2); // nothing else needs the room
        tests().cancel();

        dock()->close(); // never an empty window
        QVERIFY(m_window->welcome().isVisible());
        m_window->openScans(smallTest());
        QVERIFY(!m_window->welcome().isVisible());
        m_window->showWelcome();
        QVERIFY(m_window->welcome().isVisible());
        QVERIFY(dock()->isHidden());
    }

    void presentedTheyStay()
    {
        m_window->openScans(smallTest());
        QVERIFY(settle());
        QTest::keyClick(m_window.get(), Qt::Key_F5);
        QVERIFY(!m_window->menuBar()->isVisible());
        QVERIFY(dock()->isVisible());
        QVERIFY(!m_window->welcome().isVisible());
        QTest::keyClick(m_window.get(), Qt::Key_F5);
        QVERIFY(m_window->menuBar()->isVisible());
        QVERIFY(dock()->isVisible());
        QVERIFY(!m_window->welcome().isVisible());
        int panels = 0;
        for (const QDockWidget *each : m_window->findChildren<QDockWidget *>())
            panels += each->isVisible() ? 1 : 0;
        QCOMPARE(panels, 1);
    }

    void scansFillTheViews()
    {
        QSignalSpy walks(&tests(), &SequentialTests::walksChanged);
        QSignalSpy curves(&tests(), &SequentialTests::curvesChanged);
        m_window->openScans(smallTest());
        QVERIFY(tests().isRunning());
        QVERIFY(settle());
        QVERIFY(walks.count() >= 2); // they grow
        QVERIFY(curves.count() >= 9);

        QCOMPARE(panel().walk().walks().size(), std::size_t(30));
        double counted = 0.0;
        for (const BarPlot::Series &series : panel().stopping().series())
            for (const double count : series.values)
                counted += count;
        QCOMPARE(counted, 30.0);
        QCOMPARE(panel().asn().chart().curves.size(), std::size_t(6));
        QCOMPARE(panel().asn().chart().curves[1].points.size(), std::size_t(9));
        QCOMPARE(panel().variation().chart().curves.size(), std::size_t(2));
        QCOMPARE(panel().prior().chart().curves[0].points.size(), priorDeviations().size());
        QCOMPARE(panel().sectors().series().size(), std::size_t(2));
        QCOMPARE(tests().sectorRounds()->visits.size(), std::size_t(18));
        QVERIFY(tests().fixedSize());
        QCOMPARE(tests().sectorRounds()->fixedStages, 18 * *tests().fixedSize());
        QCOMPARE(tests().selected(), 1);
        QCOMPARE(panel().trajectory().posterior().yAxis().count, Index(20)); // the finest axis
        QCOMPARE(panel().trajectory().scan().values().size(), std::size_t(80));

        QVERIFY2(runSentence(tests()).startsWith("Run 1 with a target:"), qPrintable(runSentence(tests())));
        QVERIFY2(curvesSentence(tests()).contains("overshoot"), qPrintable(curvesSentence(tests())));
        QVERIFY2(priorSentence(tests()).contains("20 cells"), qPrintable(priorSentence(tests())));
        QVERIFY2(sectorsSentence(tests()).contains("18 looks"), qPrintable(sectorsSentence(tests())));
    }

    void resultsDoNotDependOnTheWindow()
    {
        const ScanTest test = smallTest();
        m_window->openScans(test);
        QVERIFY(settle());
        const SequentialModel model = scanModel(test.scene, test.designSnrDb);
        for (std::size_t i = 0; i < tests().walks().size(); ++i) {
            const ScanRun run{i % 2 == 1, int(i / 2)};
            QVERIFY(tests().walks()[i].first == run);
            QVERIFY(tests().walks()[i].second.lnLambda == walkScan(test, model, run).lnLambda);
        }
        QCOMPARE(tests().points()[3].h1.stages.value, measureScanPoint(test, curveSnrs(test)[3]).h1.stages.value);
        QCOMPARE(tests().sectorRounds()->stages, visitSectorsOf(test, 0).stages);
    }

    void aClickSelectsEverywhere()
    {
        m_window->openScans(smallTest());
        QVERIFY(settle());
        WalkPlot &walk = panel().walk();
        // A walk on noise that no other one lies on: the one that stops last.
        int last = 0;
        for (int i = 0; i < 30; i += 2)
            if (tests().walks()[std::size_t(i)].second.stages > tests().walks()[std::size_t(last)].second.stages)
                last = i;
        const Index stages = tests().walks()[std::size_t(last)].second.stages;
        const auto posteriorBefore = panel().trajectory().posterior().values();
        QTest::mouseClick(walk.canvas(), Qt::LeftButton, {}, walk.position(last, stages).toPoint());
        const int selected = tests().selected();
        QCOMPARE(tests().walks()[std::size_t(selected)].second.stages, stages);
        QVERIFY(settle());
        QCOMPARE(walk.selected(), selected);
        QCOMPARE(tests().stage(), stages);
        QCOMPARE(panel().slider().maximum(), int(stages));
        QVERIFY(panel().trajectory().posterior().values() != posteriorBefore);
        QCOMPARE(std::ssize(panel().trajectory().posterior().values()) / panel().trajectory().posterior().yAxis().count,
                 stages);
        QVERIFY2(runSentence(tests()).contains("of noise only"), qPrintable(runSentence(tests())));

        // A click in the middle of the posterior looks at that stage; the scan follows.
        panel().tabs().setCurrentIndex(1);
        QCoreApplication::processEvents();
        CellPicture &posterior = panel().trajectory().posterior();
        QTest::mouseClick(posterior.canvas(), Qt::LeftButton, {}, posterior.canvasPosition(2.0, 10.0).toPoint());
        QCOMPARE(tests().stage(), Index(2));
        QVERIFY(settle());
        QCOMPARE(tests().scan()->stage, Index(2));
        QCOMPARE(*walk.cursor(), 2.0);

        // A bar takes one of the tests that stopped there.
        panel().tabs().setCurrentIndex(0);
        QCoreApplication::processEvents();
        BarPlot &stopping = panel().stopping();
        const Index place = tests().walks()[3].second.stages;
        QTest::mouseClick(stopping.canvas(), Qt::LeftButton, {}, stopping.canvasPosition(double(place), 0.1).toPoint());
        QCOMPARE(tests().walks()[std::size_t(tests().selected())].second.stages, place);
    }

    void jAndLStepStages()
    {
        openLine();
        m_window->openScans(smallTest()); // beside an open recording, whose keys J and L are too
        QVERIFY(settle());
        QVERIFY(m_window->workbench().isVisible());
        tests().select(0);
        QVERIFY(settle());
        const Index stages = tests().stage();
        QVERIFY(stages > 2);
        panel().walk().setFocus();
        QVERIFY(panel().walk().hasFocus());
        const auto cursor = m_window->document().viewport().cursor();
        QTest::keyClick(&panel().walk(), Qt::Key_J);
        QTest::keyClick(&panel().walk(), Qt::Key_J);
        QCOMPARE(tests().stage(), stages - 2);
        QTest::keyClick(&panel().walk(), Qt::Key_L);
        QTest::keyClick(&panel().walk(), Qt::Key_L);
        QTest::keyClick(&panel().walk(), Qt::Key_L); // there is no more
        QCOMPARE(tests().stage(), stages);
        QVERIFY(m_window->document().viewport().cursor() == cursor);
        panel().slider().setValue(1);
        QCOMPARE(tests().stage(), Index(1));
        auto *axes = panel().trajectory().findChild<QComboBox *>(); // which has the focus when its page is shown
        QTest::keyClick(axes, Qt::Key_L);
        QCOMPARE(tests().stage(), Index(2));
        QTest::keyClick(axes, Qt::Key_J);
        QCOMPARE(tests().stage(), Index(1));
        m_window->workbench().output()->setFocus();
        QTest::keyClick(m_window->workbench().output(), Qt::Key_L);
        QVERIFY(m_window->document().viewport().cursor() != cursor);
        QCOMPARE(tests().stage(), Index(1));
    }

    void settingsComeFromTheForm()
    {
        m_window->openScans(smallTest());
        QVERIFY(settle());
        auto *edit = qobject_cast<QLineEdit *>(panel().form().editor("sprt.falseAlarm"));
        QVERIFY(edit);
        QCOMPARE(edit->text(), QString("0.01"));
        edit->selectAll();
        QTest::keyClicks(edit, "0.1");
        QTest::keyClick(edit, Qt::Key_Return);
        QCOMPARE(panel().form().value().sprt.falseAlarm, 0.1);
        for (QPushButton *button : panel().findChildren<QPushButton *>())
            if (button->text() == "Run")
                QTest::mouseClick(button, Qt::LeftButton);
        QVERIFY(tests().isRunning());
        QCOMPARE(tests().test().sprt.falseAlarm, 0.1);
        QVERIFY(settle());
        QVERIFY(std::abs(panel().walk().marks()[0].at - std::log(9.9)) < 1e-9);
    }

    void mistakesAreSaid()
    {
        QSignalSpy failed(&panel(), &SequentialPanel::failed);
        ScanTest test = smallTest();
        test.targetSectors = 9;
        m_window->openScans(test);
        QCOMPARE(failed.count(), 1);
        QVERIFY(!tests().isRunning());
        QVERIFY(m_window->messages().isVisible());
        test.targetSectors = 1;
        m_window->openScans(test);
        QVERIFY(tests().isRunning());
        QVERIFY(!m_window->messages().isVisible());
    }

    void cancelLeavesWhatThereIs()
    {
        ScanTest test = smallTest();
        test.trials = 100000;
        m_window->openScans(test);
        QVERIFY(QTest::qWaitFor([this] { return tests().sectorRounds().has_value(); }, patience));
        tests().cancel();
        QVERIFY(!tests().isRunning());
        QVERIFY(settle());
        const std::size_t points = tests().points().size();
        QCOMPARE(tests().walks().size(), std::size_t(30));
        QTest::qWait(50);
        QCOMPARE(tests().points().size(), points); // nothing trickles in
        QVERIFY(!tests().isFixedSizeKnown());
        tests().select(4); // what is there can still be looked into
        QVERIFY(settle());
        QVERIFY(tests().inspection());
    }

    void aNewRunReplacesTheOld()
    {
        ScanTest test = smallTest();
        test.trials = 100000;
        m_window->openScans(test);
        QVERIFY(QTest::qWaitFor([this] { return !tests().isEmpty(); }, patience));
        test = smallTest();
        test.walks = 3;
        m_window->openScans(test);
        QVERIFY(tests().isEmpty());
        QVERIFY(settle());
        QCOMPARE(tests().walks().size(), std::size_t(6));
        QCOMPARE(tests().points().size(), std::size_t(9));
    }

    void theRecordingsViewIsTested()
    {
        openLine();
        ScanTest test = panel().form().value();
        test.sprt.cutOffStage = 0; // 20 stages of the radar's are less than this line takes
        panel().form().setValue(test);
        Viewport &viewport = m_window->document().viewport();
        viewport.zoomTo({25.0, 50.0}, {100.0, 140.0}); // where the line is
        panel().startOnSelection();
        QVERIFY(settle());
        QVERIFY(!tests().isOfScans());
        QCOMPARE(tests().walks().size(), std::size_t(1));
        const SprtResult &found = tests().walks()[0].second;
        QVERIFY(found.decision == SprtDecision::H1);
        QVERIFY2(runSentence(tests()).contains("a target accepted"), qPrintable(runSentence(tests())));
        QCOMPARE(panel().trajectory().posterior().yAxis().unit, std::string("Hz"));
        // Its trajectory ends on the line.
        const auto &trajectory = tests().inspection()->test.result.trajectory;
        QCOMPARE(trajectory.size(), std::size_t(found.stages));
        QVERIFY(std::abs(panel().trajectory().posterior().yAxis().value(double(trajectory.back()[0])) - 120.0) < 4.0);
        QVERIFY(panel().trajectory().posterior().yAxis().first >= 99.0
                && panel().trajectory().posterior().yAxis().last() <= 141.0);
        QVERIFY(panel().asn().chart().curves.empty());

        // The cut-off counts as well.
        const ScanTest before = test;
        test.sprt.cutOffStage = 3;
        test.sprt.falseAlarm = 1e-12; // far from decided by then
        test.sprt.miss = 1e-12;
        panel().form().setValue(test);
        panel().startOnSelection();
        QVERIFY(settle());
        QCOMPARE(tests().walks()[0].second.stages, Index(3));
        QVERIFY(tests().walks()[0].second.isForced);
        panel().form().setValue(before);

        viewport.zoomTo({0.0, 15.0}, {300.0, 400.0}); // where there is nothing
        panel().startOnSelection();
        QVERIFY(settle());
        QVERIFY(tests().walks()[0].second.decision != SprtDecision::H1);
        // What "no target" does not say is said. Designed for 6 dB, it takes few windows.
        SequentialTests::Selection strong = tests().selection();
        strong.model.snr = 4.0;
        tests().start(strong, tests().test().sprt);
        QVERIFY(settle());
        QVERIFY(tests().walks()[0].second.decision == SprtDecision::H0);
        QVERIFY2(runSentence(tests()).contains("lines that start later"), qPrintable(runSentence(tests())));
        QVERIFY2(recordingNote(tests()).contains("“No target” is final"), qPrintable(recordingNote(tests())));
        QVERIFY2(recordingNote(tests()).contains("one frame in 2"), qPrintable(recordingNote(tests())));
        const std::vector<double> &walk = tests().walks()[0].second.lnLambda;
        for (std::size_t stage = 1; stage < walk.size(); stage += 2)
            QVERIFY(std::abs(walk[stage] - walk[stage - 1]) < 1e-9); // frames between share samples
    }

    void badScenarios()
    {
        QVERIFY(isScanScenario(write("scans.json", R"({"kind": "scans", "rangeCells": 10})")));
        QVERIFY(!isScanScenario(write("lines.json", R"({"kind": "lines"})")));
        QVERIFY(!isScanScenario(write("broken.json", "{")));
        QVERIFY(!isScanScenario(write("list.json", "[1]")));
        QVERIFY(!isScanScenario(m_folder.filePath("nowhere.json")));
        const QString bad = write("bad.json", R"({"kind": "scans", "rangeCells": -3})");
        m_window->open(bad);
        QVERIFY(m_window->messages().isVisible());
        QVERIFY(m_window->welcome().isVisible());
        QVERIFY(tests().isEmpty());
        m_window->open(m_folder.filePath("scans.json"));
        QVERIFY(!m_window->messages().isVisible());
        QCOMPARE(tests().test().scene.rangeCells, 10);
    }

    void viewsAreSaved()
    {
        m_window->openScans(smallTest());
        QVERIFY(settle());
        QCOMPARE(panel().views().all().size(), std::size_t(8));
        for (const SequentialViews::View &view : panel().views().all()) {
            for (const char *extension : {"png", "svg", "pdf", "csv"}) {
                const QString path = m_folder.filePath(QString("view.%1").arg(extension));
                saveView(*view.widget, view.csv(), path);
                QFile file(path);
                QVERIFY(file.open(QIODevice::ReadOnly));
                const QByteArray bytes = file.readAll();
                if (QString(extension) == "png")
                    QCOMPARE(QImage::fromData(bytes).size(), view.widget->size());
                else if (QString(extension) == "svg")
                    QVERIFY(bytes.contains("<svg") && bytes.size() > 1000);
                else if (QString(extension) == "pdf")
                    QVERIFY(bytes.startsWith("%PDF"));
                else
                    QVERIFY2(bytes.count('\n') > 5 && bytes.split('\n')[0].count(',') >= 2,
                             bytes.left(200).constData());
            }
        }
        // The numbers can be made again: of all that was tested, and of the stage that was looked at.
        tests().select(3);
        QVERIFY(settle());
        tests().setStage(2);
        QVERIFY(settle());
        for (const std::size_t i : {0, 2, 3}) {
            const QString path = m_folder.filePath(QString("again-%1.csv").arg(i));
            panel().views().saveTo(panel().views().all()[i], path);
            QProcess replay;
            replay.start(QStringLiteral(FAINTLINE_BINARY_DIR "/app/faintline"), {"replay", path});
            QVERIFY(replay.waitForFinished(patience));
            QCOMPARE(replay.readAllStandardError(), QByteArray());
            QCOMPARE(replay.readAllStandardOutput(), QFileInfo(path).fileName().toUtf8() + ": the same bytes\n");
        }
        QVERIFY_THROWS_EXCEPTION(Error, saveView(panel().walk(), "", m_folder.filePath("view.doc")));
        QVERIFY_THROWS_EXCEPTION(Error, saveView(panel().walk(), "", m_folder.filePath("no/such/folder.png")));
    }

private:
    SequentialPanel &panel() { return m_window->panel<SequentialPanel>(); }
    SequentialTests &tests() { return m_window->sequentialTests(); }
    bool settle()
    {
        return QTest::qWaitFor([this] { return !tests().isBusy(); }, patience);
    }
    QDockWidget *dock() { return m_window->findChild<QDockWidget *>("sequentialDock"); }
    QString write(const QString &name, const QByteArray &text) { return writeFile(m_folder, name, text); }

    void openLine()
    {
        const QString scene =
            write("line.json", R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 60, "lines": [
        {"snrDb": 6, "referenceSeconds": 0.5, "startSeconds": 20, "durationSeconds": 35, "frequencyHz": 120}]})");
        QVERIFY(openAndSettle(*m_window, scene));
        QVERIFY(m_window->document().analysis());
    }
};

FAINTLINE_WINDOW_TEST(tst_Sequential)
#include "tst_Sequential.moc"
