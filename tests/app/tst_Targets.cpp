// Targets of a sonar scene placed on the map by mouse, and edited in a table: what is simulated, undone and saved.

#include "app/document/Recovery.h"
#include "app/openWindow.h"
#include "app/panels/TargetModel.h"
#include "app/panels/TargetsPanel.h"
#include "app/welcome/WelcomePage.h"
#include "app/workspace/PingBench.h"
#include "session/Session.h"
#include "spectrum/SimulatedPings.h"
#include "widgets/pings/PingMap.h"
#include "widgets/pings/PolarView.h"

#include <qwt_plot_canvas.h>

#include <QComboBox>
#include <QHeaderView>
#include <QLineEdit>
#include <QProcess>
#include <QPushButton>
#include <QTableView>

#include <cmath>

using namespace faintline;
using namespace faintline::test;

namespace {

const char *const text = R"({"kind": "pings", "pings": 24, "rangeCells": 120, "beams": 8, "seed": 5, "targets": [
    {"snrDb": 11, "rangeMetres": 3200, "bearingDegrees": 270, "appearPing": 4,
     "legs": [{"pings": 12, "rangeCellsPerPing": 0.5}]}]})";

/// Small enough to be analysed at once: nine rates a cell.
void takeNineRates(AnalysisSettings &settings)
{
    settings.model.motion = Motion::Slopes;
    settings.model.lowestSlope = -1;
    settings.model.highestSlope = 1;
    settings.detector = SmdSettings{SmdSettings::Reset::Mean, 0.0};
    settings.decide.thresholdNats = 22.0;
    settings.decide.inhibitCells = {2.0, 1.0};
    settings.decide.forgetCells = {4.0, 1.0};
    settings.track.windowCells = {4.0, 1.0};
}

} // namespace

class tst_Targets : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase();
    void init();
    void cleanup() { m_window.reset(); }

    void aClickPlacesATargetInThePingShown();
    void aDragDrawsALegThatEndsAtThePointer();
    void furtherDragsAndClicksAddLegs();
    void cornersAreDraggedAndRemoved();
    void escapeAbandonsTheDragThenEndsPlacing();
    void withoutThePanelTheMapTakesNoTargets();
    void fromAboveItIsTheSame();
    void theTableAndTheMapShowTheSame();
    void typedNumbersChangeTheScene();
    void badInputGivesOneLine_data();
    void badInputGivesOneLine();
    void everythingIsReachedByKeyboard();
    void thePingsAreSimulatedAndDetectedAgain();
    void theNewestSceneWins();
    void everyStepIsUndone();
    void aSavedSceneIsSimulatedByTheCommandLine();
    void unsavedTargetsSurvive();
    void aNewSceneHasNoTargets();
    void otherPingsAreNotEdited();

private:
    PingBench &bench() const { return m_window->pingBench(); }
    TargetsPanel &panel() const { return m_window->targets(); }
    const PingScene &scene() const { return *m_window->document().source().pings; }
    const PingTarget &last() const { return scene().targets.back(); }
    WaterfallView &plane() const { return *bench().output()->plane(); }
    QWidget *canvas() const { return plane().canvas(); }
    QPoint at(double range, double bearing) const { return plane().positionOf({range, bearing}).toPoint(); }
    QPoint cornerOf(int target, int corner) const
    {
        const ScenePlace place = cornersOf(scene(), scene().targets[std::size_t(target)])[std::size_t(corner)].place;
        return at(place.rangeMetres, place.bearingDegrees);
    }
    /// Press, move in two steps, release.
    void drag(QWidget *on, QPoint from, QPoint to) const
    {
        QTest::mousePress(on, Qt::LeftButton, {}, from);
        QTest::mouseMove(on, (from + to) / 2);
        QTest::mouseMove(on, to);
        QTest::mouseRelease(on, Qt::LeftButton, {}, to);
    }
    void startPlacing() const { QTest::mouseClick(panel().placeButton(), Qt::LeftButton); }
    /// Where the simulated target is in a ping.
    ScenePlace placeIn(int target, int ping) const
    {
        const TruthTarget &truth = m_window->document().pingTruth().targets[std::size_t(target)];
        const auto k = std::size_t(ping - truth.firstPing);
        return {truth.rangeMetres[k], truth.bearingDegrees[k]};
    }
    /// Types into a cell as a user does.
    void type(int row, TargetColumn column, const QString &what) const
    {
        QTableView &table = *panel().table();
        table.setFocus();
        table.setCurrentIndex(table.model()->index(row, int(column)));
        QTest::keyClick(&table, Qt::Key_Return);
        auto *edit = table.findChild<QLineEdit *>();
        QVERIFY(edit);
        edit->selectAll();
        QTest::keyClicks(edit, what);
        QTest::keyClick(edit, Qt::Key_Return);
        QCoreApplication::processEvents(); // the editor commits when it gets back to the event loop
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }
    QString cell(int row, TargetColumn column) const
    {
        return panel().table()->model()->index(row, int(column)).data().toString();
    }

    QTemporaryDir m_folder;
    QString m_path;
    std::unique_ptr<MainWindow> m_window;
};

void tst_Targets::initTestCase()
{
    Theme::apply(Theme::Kind::Light);
    m_path = writeFile(m_folder, "sea.json", text);
}

void tst_Targets::init()
{
    m_window = newWindow({1400, 1000});
    m_window->welcome().stop();
    QVERIFY(openAndSettle(*m_window, m_path, takeNineRates));
    QTest::keyClick(m_window.get(), Qt::Key_D, Qt::ControlModifier | Qt::ShiftModifier);
    QVERIFY(panel().isVisible());
    QVERIFY(!bench().histories()->isVisible()); // the maps have the room
    bench().showPing(2);
}

void tst_Targets::aClickPlacesATargetInThePingShown()
{
    startPlacing();
    QTest::mouseClick(canvas(), Qt::LeftButton, {}, at(3700.0, 90.0));
    QCOMPARE(scene().targets.size(), std::size_t(2));
    QVERIFY2(std::abs(last().rangeMetres - 3700.0) < 10.0, qPrintable(QString::number(last().rangeMetres)));
    QVERIFY(std::abs(last().bearingDegrees - 90.0) < 3.0);
    QCOMPARE(last().appearPing, 2);
    QCOMPARE(last().snrDb, 11.0); // as the one before
    QVERIFY(last().legs.empty());
    QCOMPARE(panel().editor().selected(), (TargetHandle{1, 0}));
    QCOMPARE(m_window->document().undoStack().count(), 1);
}

void tst_Targets::aDragDrawsALegThatEndsAtThePointer()
{
    startPlacing();
    drag(canvas(), at(3300.0, 45.0), at(3600.0, 100.0));
    QCOMPARE(last().legs.size(), std::size_t(1));
    QCOMPARE(last().legs[0].pings, 20);
    QCOMPARE(last().legs[0].beamsPerPing != 0.0, true); // in the scene's unit
    QCOMPARE(last().legs[0].rangeRateMetresPerSecond, 0.0);
    const ScenePlace end = placeIn(1, 22);
    QVERIFY2(std::abs(end.rangeMetres - 3600.0) < 15.0, qPrintable(QString::number(end.rangeMetres)));
    QVERIFY(std::abs(end.bearingDegrees - 100.0) < 6.0);
    QCOMPARE(m_window->document().undoStack().count(), 1); // target and leg are one gesture
    QCOMPARE(m_window->document().undoStack().undoText(), QString("Place a target"));
}

void tst_Targets::furtherDragsAndClicksAddLegs()
{
    type(0, TargetColumn::Pings, "8");
    startPlacing();
    const PingLeg first = scene().targets[0].legs[0];
    drag(canvas(), cornerOf(0, 1), at(3400.0, 250.0)); // from the end of the existing target
    QCOMPARE(scene().targets.size(), std::size_t(1));
    QCOMPARE(last().legs.size(), std::size_t(2));
    QCOMPARE(last().legs[0], first);
    QCOMPARE(last().legs[1].pings, 11); // pings 13 … 24
    QCOMPARE(panel().editor().selected(), (TargetHandle{0, 2}));
    type(1, TargetColumn::Pings, "5");
    QTest::mouseClick(canvas(), Qt::LeftButton, Qt::ShiftModifier, at(3800.0, 200.0));
    QCOMPARE(last().legs.size(), std::size_t(3));
    const ScenePlace end = placeIn(0, 23);
    QVERIFY2(std::abs(end.rangeMetres - 3800.0) < 15.0, qPrintable(QString::number(end.rangeMetres)));
    // No ping is left for a fourth leg.
    QTest::mouseClick(canvas(), Qt::LeftButton, Qt::ShiftModifier, at(3900.0, 200.0));
    QCOMPARE(last().legs.size(), std::size_t(3));
    QVERIFY2(panel().sentence().startsWith("Target T1, leg 4: has no ping left"), qPrintable(panel().sentence()));
}

void tst_Targets::cornersAreDraggedAndRemoved()
{
    // A drag of a corner changes the leg, also while nothing is being placed.
    drag(canvas(), cornerOf(0, 1), at(3500.0, 270.0));
    QVERIFY(std::abs(placeIn(0, 16).rangeMetres - 3500.0) < 15.0);
    QCOMPARE(scene().targets[0].rangeMetres, 3200.0);
    QCOMPARE(m_window->document().undoStack().undoText(), QString("Change a leg"));
    const double rate = scene().targets[0].legs[0].rangeCellsPerPing;
    drag(canvas(), cornerOf(0, 0), at(3900.0, 135.0));
    QVERIFY(std::abs(scene().targets[0].rangeMetres - 3900.0) < 10.0);
    QCOMPARE(scene().targets[0].legs[0].rangeCellsPerPing, rate);
    // Delete takes the selected leg, then the target.
    QTest::mouseClick(canvas(), Qt::LeftButton, {}, cornerOf(0, 1));
    QCOMPARE(panel().editor().selected(), (TargetHandle{0, 1}));
    QTest::keyClick(&plane(), Qt::Key_Delete);
    QVERIFY(scene().targets[0].legs.empty());
    QCOMPARE(panel().editor().selected(), (TargetHandle{0, 0}));
    QTest::keyClick(&plane(), Qt::Key_Delete);
    QVERIFY(scene().targets.empty());
    QVERIFY(panel().editor().selected().isNone());
    QCOMPARE(m_window->document().undoStack().count(), 4);
}

void tst_Targets::escapeAbandonsTheDragThenEndsPlacing()
{
    startPlacing();
    QVERIFY(panel().editor().isPlacing());
    QTest::mousePress(canvas(), Qt::LeftButton, {}, at(3300.0, 45.0));
    QTest::mouseMove(canvas(), at(3600.0, 100.0));
    QCOMPARE(panel().editor().scene()->targets.size(), std::size_t(2));
    QTest::keyClick(&plane(), Qt::Key_Escape);
    QCOMPARE(panel().editor().scene()->targets.size(), std::size_t(1));
    QTest::mouseRelease(canvas(), Qt::LeftButton, {}, at(3600.0, 100.0));
    QCOMPARE(m_window->document().undoStack().count(), 0);
    QVERIFY(panel().placeButton()->isChecked());
    QTest::keyClick(&plane(), Qt::Key_Escape);
    QVERIFY(!panel().placeButton()->isChecked());
    QTest::mouseClick(canvas(), Qt::LeftButton, {}, at(3300.0, 45.0));
    QCOMPARE(scene().targets.size(), std::size_t(1));
    QVERIFY(std::abs(bench().viewports().place().range - 3300.0) < 10.0); // a click places the cursor again
}

void tst_Targets::withoutThePanelTheMapTakesNoTargets()
{
    startPlacing();
    panel().parentWidget()->hide();
    QVERIFY(!panel().editor().isPlacing());
    QVERIFY(bench().histories()->isVisible());
    QTest::mouseClick(canvas(), Qt::LeftButton, {}, cornerOf(0, 0));
    QVERIFY(panel().editor().selected().isNone());
    QCOMPARE(scene().targets.size(), std::size_t(1));
}

void tst_Targets::fromAboveItIsTheSame()
{
    bench().setPolar(true);
    PolarView &polar = *bench().input()->polar();
    startPlacing();
    drag(polar.canvas(), polar.positionOf({3700.0, 90.0}).toPoint(), polar.positionOf({3700.0, 180.0}).toPoint());
    QCOMPARE(scene().targets.size(), std::size_t(2));
    QVERIFY(std::abs(last().rangeMetres - 3700.0) < 30.0);
    QVERIFY(std::abs(last().bearingDegrees - 90.0) < 5.0);
    const ScenePlace end = placeIn(1, 22);
    QVERIFY2(std::abs(end.bearingDegrees - 180.0) < 6.0, qPrintable(QString::number(end.bearingDegrees)));
    QTest::keyClick(&polar, Qt::Key_Delete);
    QVERIFY(last().legs.empty());
}

void tst_Targets::theTableAndTheMapShowTheSame()
{
    QCOMPARE(panel().table()->model()->rowCount(), 1);
    QCOMPARE(cell(0, TargetColumn::Target), QString("T1"));
    QCOMPARE(cell(0, TargetColumn::Snr), QString("11"));
    QCOMPARE(cell(0, TargetColumn::From), QString("5"));
    QCOMPARE(cell(0, TargetColumn::Until), QString("end"));
    QCOMPARE(cell(0, TargetColumn::Pings), QString("12"));
    QCOMPARE(cell(0, TargetColumn::RangeRate), QString("0.5"));
    const auto title = [this](TargetColumn column) {
        return panel().table()->model()->headerData(int(column), Qt::Horizontal).toString();
    };
    QCOMPARE(title(TargetColumn::RangeRate), QString("Range rate (cells/ping)"));
    panel().unitBox()->setCurrentIndex(0);
    emit panel().unitBox()->activated(0);
    QCOMPARE(title(TargetColumn::RangeRate), QString("Range rate (m/s)"));
    QCOMPARE(cell(0, TargetColumn::RangeRate), QString("0.125")); // 5 m in 40 s
    // The table follows a drag before the mouse is released.
    startPlacing();
    QTest::mousePress(canvas(), Qt::LeftButton, {}, at(3300.0, 45.0));
    QTest::mouseMove(canvas(), at(3600.0, 45.0));
    QCOMPARE(panel().table()->model()->rowCount(), 2);
    QVERIFY(!cell(1, TargetColumn::RangeRate).isEmpty());
    QTest::mouseRelease(canvas(), Qt::LeftButton, {}, at(3600.0, 45.0));
    QCOMPARE(panel().table()->currentIndex().row(), 1);
    // A selected row selects the corner.
    panel().table()->setCurrentIndex(panel().table()->model()->index(0, int(TargetColumn::RangeRate)));
    QCOMPARE(panel().editor().selected(), (TargetHandle{0, 1}));
}

void tst_Targets::typedNumbersChangeTheScene()
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
}

void tst_Targets::badInputGivesOneLine_data()
{
    QTest::addColumn<int>("column");
    QTest::addColumn<QString>("typed");
    QTest::addColumn<QString>("line");
    QTest::newRow("no number") << int(TargetColumn::Snr) << "loud"
                               << "Target T1, SNR = loud: must lie in -60 … 80 dB";
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

void tst_Targets::badInputGivesOneLine()
{
    QFETCH(int, column);
    QFETCH(QString, typed);
    QFETCH(QString, line);
    const PingScene before = scene();
    type(0, TargetColumn(column), typed);
    QCOMPARE(panel().sentence(), line);
    QVERIFY(scene() == before);
    QCOMPARE(m_window->document().undoStack().count(), 0);
    type(0, TargetColumn::Snr, "12"); // a good number takes the line away
    QVERIFY(panel().sentence() != line);
}

void tst_Targets::everythingIsReachedByKeyboard()
{
    PingViewports::Place cursor = bench().viewports().place();
    cursor.range = 3500.0;
    cursor.bearing = 180.0;
    bench().viewports().setPlace(cursor);
    panel().addTargetButton()->setFocus();
    QTest::keyClick(panel().addTargetButton(), Qt::Key_Space);
    QCOMPARE(scene().targets.size(), std::size_t(2));
    QCOMPARE(last().rangeMetres, 3500.0);
    cursor.range = 3600.0;
    bench().viewports().setPlace(cursor);
    panel().addLegButton()->setFocus();
    QTest::keyClick(panel().addLegButton(), Qt::Key_Space);
    QCOMPARE(last().legs.size(), std::size_t(1));
    QCOMPARE(last().legs[0].rangeCellsPerPing, 0.5); // 10 cells in 20 pings
    // Digits typed on the table begin to edit; they are not the window's keys for classes.
    QTableView &table = *panel().table();
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

void tst_Targets::thePingsAreSimulatedAndDetectedAgain()
{
    const auto before = m_window->document().analysis();
    startPlacing();
    drag(canvas(), at(3400.0, 90.0), at(3600.0, 90.0));
    type(1, TargetColumn::Snr, "14");
    QVERIFY(settle(*m_window));
    const auto after = m_window->document().analysis();
    QVERIFY(after != before && m_window->document().isCurrent());
    QCOMPARE(m_window->document().pingTruth().targets.size(), std::size_t(2));
    // A track ends beside the new target's place.
    const ScenePlace end = placeIn(1, 22);
    const Grid &grid = after->grid();
    bool isFound = false;
    for (const Track &track : after->tracks)
        for (const TrackPoint &point : track.points) {
            const std::vector<double> place = grid.position(point.cell);
            isFound = isFound
                      || (point.frame == 22 && std::abs(place[0] - end.rangeMetres) < 50.0
                          && std::abs(place[1] - end.bearingDegrees) < 46.0);
        }
    QVERIFY(isFound);
    // The same as a scene that was opened from a file.
    const SimulatedPings alone(scene());
    std::vector<float> y(std::size_t(grid.size())), own(y.size());
    alone.read(22, 1, y);
    m_window->document().frames()->read(22, 1, own);
    QCOMPARE(own, y);
}

void tst_Targets::theNewestSceneWins()
{
    for (const char *snr : {"5", "6", "7", "13"})
        type(0, TargetColumn::Snr, snr);
    QVERIFY(settle(*m_window));
    QVERIFY(m_window->document().isCurrent());
    QCOMPARE(m_window->document().pingTruth().targets[0].snrDb, 13.0);
    QCOMPARE(m_window->document().analysis()->frames, m_window->document().frames());
}

void tst_Targets::everyStepIsUndone()
{
    const PingScene before = scene();
    startPlacing();
    drag(canvas(), at(3300.0, 45.0), at(3600.0, 100.0));
    const PingScene after = scene();
    plane().setFocus();
    QTest::keyClick(m_window.get(), Qt::Key_Z, Qt::ControlModifier);
    QVERIFY(scene() == before);
    QCOMPARE(panel().table()->model()->rowCount(), 1);
    QVERIFY(panel().editor().selected().isNone());
    QTest::keyClick(m_window.get(), Qt::Key_Y, Qt::ControlModifier);
    QVERIFY(scene() == after);
    QCOMPARE(panel().table()->model()->rowCount(), 2);
    QVERIFY(settle(*m_window));
    QVERIFY(m_window->document().isCurrent());
}

void tst_Targets::aSavedSceneIsSimulatedByTheCommandLine()
{
    startPlacing();
    drag(canvas(), at(3300.0, 45.0), at(3600.0, 100.0));
    const QString saved = m_folder.filePath("saved.json");
    panel().save(saved);
    QVERIFY(pingSceneFromJson(readJsonFile(saved.toStdString())) == scene());
    QProcess process;
    process.start(
        QStringLiteral(FAINTLINE_BINARY_DIR "/app/faintline-cli"),
        {"simulate", saved, "--out", m_folder.filePath("saved.npy"), "--truth", m_folder.filePath("truth.json")});
    QVERIFY(process.waitForFinished(patience));
    QVERIFY2(process.exitCode() == 0, process.readAllStandardError().constData());
    const PingTruth truth = pingTruthFromJson(readJsonFile(m_folder.filePath("truth.json").toStdString()));
    QVERIFY(truth == m_window->document().pingTruth());
}

void tst_Targets::unsavedTargetsSurvive()
{
    QTemporaryDir left;
    m_window = newWindow({1400, 1000}, {}, left.path());
    m_window->welcome().stop();
    QVERIFY(openAndSettle(*m_window, m_path, takeNineRates));
    QSignalSpy kept(&m_window->recovery(), &Recovery::kept);
    m_window->targets().editor().addTarget();
    QVERIFY(m_window->document().isModified());
    QVERIFY(kept.wait(patience));
    const Session session = readSession(kept.first().first().toString().toStdString());
    QVERIFY(session.source.pings && *session.source.pings == scene());
    QCOMPARE(scene().targets.size(), std::size_t(2));
}

void tst_Targets::aNewSceneHasNoTargets()
{
    QSignalSpy opened(&m_window->document(), &Document::opened);
    for (QPushButton *button : panel().findChildren<QPushButton *>())
        if (button->text() == "New scene")
            button->click();
    QVERIFY(opened.wait(patience));
    QVERIFY(scene().targets.empty());
    QCOMPARE(panel().table()->model()->rowCount(), 0);
    QVERIFY(panel().sentence().startsWith("No targets"));
    QCOMPARE(panel().editor().rateUnit(), RateUnit::PerSecond);
    m_window->controller().stop();
}

void tst_Targets::otherPingsAreNotEdited()
{
    const QString lines = writeFile(m_folder, "lines.json",
                                    R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 20, "lines": []})");
    QVERIFY(openAndSettle(*m_window, lines));
    QVERIFY(!panel().editor().scene());
    QVERIFY(!panel().placeButton()->isEnabled());
    QVERIFY(panel().sentence().contains("simulated scenes"));
    QCOMPARE(panel().table()->model()->rowCount(), 0);
}

QTEST_MAIN(tst_Targets)
#include "tst_Targets.moc"
