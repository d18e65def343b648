// The evaluation side from outside: an experiment is started, grows, is cancelled, looked into; a line is injected and
// taken out again.

#include "app/base/StartColumn.h"
#include "app/base/filePath.h"
#include "app/features/evaluate/EvaluatePanel.h"
#include "app/features/evaluate/ExperimentForm.h"
#include "app/features/evaluate/ExperimentsPanel.h"
#include "app/features/evaluate/ReproductionPanel.h"
#include "app/features/inspect/NoiseFitPanel.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "app/window/TrialViewer.h"
#include "app/window/TrialWindow.h"
#include "evaluate/experiments/peers.h"
#include "exchange/Session.h"
#include "support/find.h"
#include "support/test.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/table/ColumnTable.h"

#include <QCheckBox>

#include <algorithm>
#include <memory>

using namespace faintline;
using namespace faintline::test;

class tst_Evaluation : public WindowTest
{
    Q_OBJECT

private slots:
    void initTestCase();

    void anExperimentGrowsAndEnds();
    void aPointOpensItsTrials();
    void cancelKeepsTheRunsThereAre();
    void oneAfterTheOther();
    void whatCannotRunSaysWhy();
    void curvesComeBackFromFiles();
    void linesInThisRecording();
    void aLineIsInjectedAndUndone();
    void aReproductionShowsItsTable();
    void theNoiseIsMeasuredWhileItIsSeen();
    void theFormShowsTheOpenedExperiment();

private:
    bool idle()
    {
        return QTest::qWaitFor([this] { return !m_window->experiments().isBusy(); }, patience);
    }
    const Experiments::Entry &shown()
    {
        return *m_window->experiments().entry(m_window->panel<EvaluatePanel>().shown());
    }
    void fillForm(int runs)
    {
        m_window->panel<EvaluatePanel>().form().setQuick(runs, {"3 of 4", "integrator"}, {0.0, 3.0});
    }
};

void tst_Evaluation::initTestCase()
{
    Theme::apply(Theme::Kind::Dark);
    const QString scene =
        writeFile(m_folder, "scene.json", R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 60, "lines": [
        {"snrDb": 9, "referenceSeconds": 0.5, "startSeconds": 5, "durationSeconds": 40, "frequencyHz": 120}]})");
    m_window = newWindow();
    QVERIFY(openAndSettle(*m_window, scene));
    QVERIFY(m_window->document().analysis());
}

void tst_Evaluation::anExperimentGrowsAndEnds()
{
    fillForm(3);
    QSignalSpy changed(&m_window->experiments(), &Experiments::changed);
    m_window->panel<EvaluatePanel>().start();
    QVERIFY(m_window->experiments().isBusy());
    QVERIFY(idle());
    QVERIFY(shown().state == Experiments::State::Done);
    QCOMPARE(shown().runsDone(), 3);
    QVERIFY(changed.count() >= 2);
    QCOMPARE(childOf<QLabel>(m_window->panel<EvaluatePanel>(), "What is shown").text(),
             QString()); // it is the form's own
    fillForm(4);
    const QString note = childOf<QLabel>(m_window->panel<EvaluatePanel>(), "What is shown").text();
    QVERIFY2(note.contains("3 runs, 0 … 3 dB, 100 T_FT, seed 1"), qPrintable(note));
    fillForm(3);
    QCOMPARE(childOf<QLabel>(m_window->panel<EvaluatePanel>(), "What is shown").text(), QString());
    const Chart &chart = m_window->panel<EvaluatePanel>().pd().chart();
    QCOMPARE(chart.curves.size(), std::size_t(3)); // two measured, Marcum's Q
    QVERIFY(
        m_window->panel<EvaluatePanel>().pd().toolTip().contains("below theory")); // why Marcum's Q is beside its curve
    QCOMPARE(chart.curves[0].points.size(), std::size_t(2));
    QVERIFY(chart.curves[1].points[0].y > chart.curves[0].points[0].y); // who knows the duration is better

    // The same as the library's own answer.
    Campaign whole{shown().campaign->experiment, {}, {}};
    carryOut(whole, {0, 1, 2});
    QVERIFY(whole.outcomes == shown().campaign->outcomes);
}

void tst_Evaluation::aPointOpensItsTrials()
{
    ChartPlot &pd = m_window->panel<EvaluatePanel>().pd();
    QSignalSpy opened(&m_window->trials(), &TrialViewer::shown);
    emit pd.pointActivated(1, 1);
    QVERIFY(opened.wait(patience));
    TrialWindow *window = m_window->trials().window();
    QVERIFY(window->isVisible());
    QVERIFY2(sentenceOf(*window).startsWith("integrator at 3.0 dB: detected"), qPrintable(sentenceOf(*window)));
    QVERIFY(window->workbench().output()->picture());
    QCOMPARE(window->document().truth().lines.size(), std::size_t(1));
    QVERIFY(!window->document().shownEvents().empty());
    // What was open stays open.
    QCOMPARE(m_window->document().sourceName(), QString("scene.json"));
    const QString first = window->windowTitle();
    emit window->stepRequested(1, false);
    QVERIFY(opened.wait(patience));
    QVERIFY(window->windowTitle() != first);
    window->close();
}

void tst_Evaluation::cancelKeepsTheRunsThereAre()
{
    fillForm(10000);
    m_window->panel<EvaluatePanel>().start();
    const int id = m_window->panel<EvaluatePanel>().shown();
    QVERIFY(QTest::qWaitFor([&] { return m_window->experiments().entry(id)->runsDone() >= 1; }, patience));
    m_window->panel<EvaluatePanel>().cancel();
    QVERIFY(m_window->experiments().entry(id)->state == Experiments::State::Cancelled);
    QVERIFY(!m_window->experiments().isBusy());
    const int runs = m_window->experiments().entry(id)->runsDone();
    QVERIFY(runs >= 1 && runs < 10000);
    QVERIFY(!m_window->panel<EvaluatePanel>().pd().chart().curves.empty());
    QTest::qWait(50);
    QCOMPARE(m_window->experiments().entry(id)->runsDone(), runs); // nothing trickles in
}

void tst_Evaluation::oneAfterTheOther()
{
    Experiments &experiments = m_window->experiments();
    fillForm(1);
    m_window->panel<EvaluatePanel>().start();
    const int first = m_window->panel<EvaluatePanel>().shown();
    m_window->panel<EvaluatePanel>().start();
    const int second = m_window->panel<EvaluatePanel>().shown();
    m_window->panel<EvaluatePanel>().start();
    const int third = m_window->panel<EvaluatePanel>().shown();
    QVERIFY(experiments.entry(first)->state == Experiments::State::Running);
    QVERIFY(experiments.entry(second)->state == Experiments::State::Waiting);
    experiments.remove(second);
    QVERIFY(idle());
    QVERIFY(experiments.entry(first)->state == Experiments::State::Done);
    QVERIFY(!experiments.entry(second));
    QVERIFY(experiments.entry(third)->state == Experiments::State::Done);
    QVERIFY(experiments.entry(first)->campaign->outcomes == experiments.entry(third)->campaign->outcomes);
    emit m_window->panel<ExperimentsPanel>().showRequested(first);
    QCOMPARE(m_window->panel<EvaluatePanel>().shown(), first);
}

void tst_Evaluation::whatCannotRunSaysWhy()
{
    ExperimentForm &form = m_window->panel<EvaluatePanel>().form();
    form.setQuick(1, {}, {0.0, 3.0});
    QVERIFY(form.obstacle().contains("detector"));
    form.setQuick(1, {"3 of 4"}, {});
    QVERIFY(form.obstacle().contains("snrDb"));
    fillForm(1);
    QCOMPARE(form.obstacle(), QString());
}

void tst_Evaluation::curvesComeBackFromFiles()
{
    ExperimentsPanel &list = m_window->panel<ExperimentsPanel>();
    const int id = m_window->panel<EvaluatePanel>().shown();
    const Chart before = m_window->panel<EvaluatePanel>().pd().chart();
    list.exportTo(id, m_folder.filePath("curve.csv"));
    list.exportTo(id, m_folder.filePath("runs.jsonl"));
    QVERIFY_EXCEPTION_THROWN(list.exportTo(id, m_folder.filePath("curve.svg")),
                             Error); // JSON lines under a drawing's name
    QVERIFY(!QFile::exists(m_folder.filePath("curve.svg")));
    // The command line makes the same curve from what stands beside it.
    QProcess replay;
    replay.setWorkingDirectory(m_folder.path());
    replay.start(QStringLiteral(FAINTLINE_BINARY_DIR "/app/faintline-cli"), {"replay", "curve.csv"});
    QVERIFY(replay.waitForFinished(patience));
    QCOMPARE(replay.readAllStandardError(), QByteArray());
    QCOMPARE(replay.readAllStandardOutput(), QByteArray("curve.csv: the same bytes\n"));
    fillForm(7);
    m_window->panel<EvaluatePanel>().show(list.importFile(m_folder.filePath("runs.jsonl")));
    QCOMPARE(childOf<QLabel>(m_window->panel<EvaluatePanel>(), "What is shown").text(),
             QString()); // the form shows its values
    QCOMPARE(m_window->panel<EvaluatePanel>().pd().chart().curves.size(), before.curves.size());
    QVERIFY(shown().campaign->outcomes == m_window->experiments().entry(id)->campaign->outcomes);
    m_window->panel<EvaluatePanel>().show(list.importFile(m_folder.filePath("curve.csv")));
    const Chart after = m_window->panel<EvaluatePanel>().pd().chart();
    QCOMPARE(after.curves.size(), std::size_t(2));
    QCOMPARE(after.curves[1].points[1].y, before.curves[1].points[1].y);
    QVERIFY_EXCEPTION_THROWN(list.importFile(m_folder.filePath("scene.json")), Error);
}

/// The form beside the curves of an experiment has its values, and its detectors though they are not the form's own.
void tst_Evaluation::theFormShowsTheOpenedExperiment()
{
    Experiment lines;
    lines.trials = 2;
    lines.seed = 9;
    lines.snrDb = {-2.0, 0.0, 3.0}; // not equally spaced
    lines.fading = Fading::Rayleigh;
    lines.durationSeconds = 80.0;
    lines.driftHzPerSecond = 0.1;
    lines.detectors = {peer("integrator", 80.0), peer("energy", 80.0)};
    lines.detectors.back().name = "one frame";
    ExperimentForm &form = m_window->panel<EvaluatePanel>().form();
    fillForm(3);
    m_window->panel<EvaluatePanel>().show(m_window->panel<ExperimentsPanel>().open(
        writeFile(m_folder, "own.json", QByteArray::fromStdString(toJson(lines).dump()))));
    QVERIFY(idle());
    QVERIFY(form.experiment({}) == lines);
    QCOMPARE(childOf<QLabel>(m_window->panel<EvaluatePanel>(), "What is shown").text(), QString());
    const auto hasBox = [&] {
        return std::ranges::any_of(form.findChildren<QCheckBox *>(),
                                   [](const QCheckBox *box) { return box->text() == "one frame" && box->isChecked(); });
    };
    QVERIFY(hasBox());
    lines.detectors.front().settings.model.snr = 2.0; // another one of the same name
    m_window->panel<EvaluatePanel>().show(m_window->panel<ExperimentsPanel>().open(
        writeFile(m_folder, "own.json", QByteArray::fromStdString(toJson(lines).dump()))));
    QVERIFY(idle());
    QVERIFY(form.experiment({}) == lines);
    QVERIFY(std::ranges::any_of(form.findChildren<QCheckBox *>(),
                                [](const QCheckBox *box) { return box->text() == "integrator, as opened"; }));
    lines.detectors.front() = peer("integrator", 80.0);
    lines.detectors.pop_back();
    m_window->panel<EvaluatePanel>().show(m_window->panel<ExperimentsPanel>().open(
        writeFile(m_folder, "own.json", QByteArray::fromStdString(toJson(lines).dump()))));
    QVERIFY(idle());
    QVERIFY(form.experiment({}) == lines);
    QVERIFY(!hasBox());
}

void tst_Evaluation::linesInThisRecording()
{
    ExperimentForm &form = m_window->panel<EvaluatePanel>().form();
    form.setQuick(4, {"integrator"}, {6.0});
    form.setInRecording(true);
    m_window->panel<EvaluatePanel>().start();
    QVERIFY(idle());
    form.setInRecording(false);
    QVERIFY2(shown().state == Experiments::State::Done, qPrintable(shown().failure));
    QCOMPARE(shown().runsDone(), 4);
    QCOMPARE(m_window->panel<EvaluatePanel>().pd().chart().curves.size(), std::size_t(1));
    QSignalSpy opened(&m_window->trials(), &TrialViewer::shown);
    emit m_window->panel<EvaluatePanel>().pd().pointActivated(0, 0);
    QVERIFY(opened.wait(patience));
    QCOMPARE(m_window->trials().window()->document().truth().lines.size(), std::size_t(1));
    m_window->trials().window()->close();
}

void tst_Evaluation::aLineIsInjectedAndUndone()
{
    Document &document = m_window->document();
    const RecordingPointer before = document.recording();
    const std::size_t eventsBefore = document.shownEvents().size();
    LineSettings line;
    line.snrDb = 9.0;
    line.referenceSeconds = 0.0; // the spectrogram's window
    line.startSeconds = 10.0;
    line.durationSeconds = 30.0;
    line.frequencyHz = 330.0;
    QSignalSpy settled(&m_window->controller(), &AnalysisController::settled);
    m_window->controller().inject(line);
    QVERIFY(QTest::qWaitFor(
        [&] { return !m_window->controller().isBusy() && document.isCurrent() && document.recording() != before; },
        patience));
    QCOMPARE(document.truth().lines.size(), std::size_t(2));
    QCOMPARE(document.source().injections.size(), std::size_t(1));
    QVERIFY(document.shownEvents().size() > eventsBefore);
    QVERIFY(document.isModified());

    // A session keeps it.
    const QString path = m_folder.filePath("injected.faintline");
    writeSession(pathBytes(path), {document.source(), {}, document.settings()});
    const OpenedSource again = openSource(readSession(pathBytes(path)).source);
    QCOMPARE(again.truth, document.truth());
    std::vector<float> a(1000), b(1000);
    document.recording()->read(0, 15000, 1000, a);
    again.recording->read(0, 15000, 1000, b);
    QCOMPARE(a, b);

    document.undoStack().undo();
    QVERIFY(QTest::qWaitFor([&] { return !m_window->controller().isBusy(); }, patience));
    QCOMPARE(document.recording(), before);
    QVERIFY(document.isCurrent());
    QCOMPARE(document.truth().lines.size(), std::size_t(1));
    QCOMPARE(document.shownEvents().size(), eventsBefore);
}

void tst_Evaluation::aReproductionShowsItsTable()
{
    const int id = m_window->experiments().start(reproducible("billon:figure1"), {true, 1});
    QVERIFY(idle());
    QVERIFY2(m_window->experiments().entry(id)->reproduction != nullptr,
             qPrintable(m_window->experiments().entry(id)->failure));
    QCOMPARE(childOf<ColumnTable>(m_window->panel<ReproductionPanel>()).model()->rowCount(), 2);
    QVERIFY(m_window->panel<ReproductionPanel>().isVisible());
    QCOMPARE(m_window->panel<ReproductionPanel>().plot().chart().curves.size(), std::size_t(2));
    m_window->panel<ExperimentsPanel>().exportTo(id, m_folder.filePath("out"));
    QVERIFY(QFile::exists(m_folder.filePath("out/billon-figure1.svg")));
}

void tst_Evaluation::theNoiseIsMeasuredWhileItIsSeen()
{
    m_window->showView("noisefit");
    QVERIFY(settle(m_window->panel<NoiseFitPanel>()));
    QCOMPARE(childOf<ColumnTable>(m_window->panel<NoiseFitPanel>()).model()->rowCount(), 6);
    QVERIFY2(sentenceOf(m_window->panel<NoiseFitPanel>()).contains("law"),
             qPrintable(sentenceOf(m_window->panel<NoiseFitPanel>())));
    QCOMPARE(m_window->panel<NoiseFitPanel>().plot().chart().curves.size(), std::size_t(7));
}

FAINTLINE_WINDOW_TEST(tst_Evaluation)
#include "tst_Evaluation.moc"
