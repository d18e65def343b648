// Targets of a sonar scene placed on the map by mouse: what is simulated, detected, undone and saved.

#include "app/TargetsTest.h"
#include "app/document/Recovery.h"
#include "app/features/opening/WelcomePage.h"
#include "app/features/pictures/PingBench.h"
#include "exchange/Session.h"
#include "scene/SimulatedPings.h"
#include "support/test.h"
#include "widgets/pings/PolarView.h"

#include <qwt_plot_canvas.h>

#include <cmath>

using namespace faintline;
using namespace faintline::test;

class tst_Targets : public TargetsTest
{
    Q_OBJECT

private slots:
    void initTestCase() { writeScene(); }
    void init() { openScene(); }
    void cleanup() { m_window.reset(); }

    void aClickPlacesATargetInThePingShown()
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

    void aDragDrawsALegThatEndsAtThePointer()
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

    void whatTheModelFollowsIsShownWhileALegIsDrawn()
    {
        startPlacing();
        QTest::mousePress(canvas(), Qt::LeftButton, {}, at(3300.0, 180.0));
        QTest::mouseMove(canvas(), at(3400.0, 180.0));
        const auto reach = panel().editor().reach();
        QVERIFY(reach.size() > 4);
        QVERIFY2(sentenceOf(panel()).startsWith("Dotted: "), qPrintable(sentenceOf(panel())));
        const auto [nearest, farthest] = std::ranges::minmax(reach, {}, &SceneEditor::Place::along);
        QTest::mouseMove(canvas(), at(farthest.along, 180.0));
        QTest::mouseRelease(canvas(), Qt::LeftButton, {}, at(farthest.along, 180.0));
        QVERIFY(std::abs(last().legs[0].rangeCellsPerPing - 1.0) < 0.1); // the fastest of the nine rates
        QVERIFY(nearest.along < 3150.0);
        QVERIFY(panel().editor().reach().empty());
        QVERIFY(!sentenceOf(panel()).startsWith("Dotted: "));
    }

    void furtherDragsAndClicksAddLegs()
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
        QVERIFY2(sentenceOf(panel()).startsWith("Target T1, leg 4: has no ping left"), qPrintable(sentenceOf(panel())));
    }

    void cornersAreDraggedAndRemoved()
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

    void escapeAbandonsTheDragThenEndsPlacing()
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
        QVERIFY(buttonOf(panel(), "Place on the map")->isChecked());
        QTest::keyClick(&plane(), Qt::Key_Escape);
        QVERIFY(!buttonOf(panel(), "Place on the map")->isChecked());
        QTest::mouseClick(canvas(), Qt::LeftButton, {}, at(3300.0, 45.0));
        QCOMPARE(scene().targets.size(), std::size_t(1));
        QVERIFY(std::abs(bench().viewports().along() - 3300.0) < 10.0); // a click places the cursor again
        startPlacing();
        QTest::keyClick(buttonOf(panel(), "Place on the map"), Qt::Key_Escape);
        QVERIFY(!panel().editor().isPlacing());
    }

    void withoutThePanelTheMapTakesNoTargets()
    {
        startPlacing();
        panel().parentWidget()->hide();
        QVERIFY(!panel().editor().isPlacing());
        QTRY_VERIFY(bench().histories()->isVisible()); // once the maps have the panel's room
        QTest::mouseClick(canvas(), Qt::LeftButton, {}, cornerOf(0, 0));
        QVERIFY(panel().editor().selected().isNone());
        QCOMPARE(scene().targets.size(), std::size_t(1));
    }

    void fromAboveItIsTheSame()
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

    void thePingsAreSimulatedAndDetectedAgain()
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

    void theNewestSceneWins()
    {
        for (const char *snr : {"5", "6", "7", "13"})
            type(0, TargetColumn::Snr, snr);
        QVERIFY(settle(*m_window));
        QVERIFY(m_window->document().isCurrent());
        QCOMPARE(m_window->document().pingTruth().targets[0].snrDb, 13.0);
        QCOMPARE(m_window->document().analysis()->frames, m_window->document().frames());
    }

    void everyStepIsUndone()
    {
        const PingScene before = scene();
        startPlacing();
        drag(canvas(), at(3300.0, 45.0), at(3600.0, 100.0));
        const PingScene after = scene();
        plane().setFocus();
        QTest::keyClick(m_window.get(), Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(scene() == before);
        QCOMPARE(table().model()->rowCount(), 1);
        QVERIFY(panel().editor().selected().isNone());
        QTest::keyClick(m_window.get(), Qt::Key_Y, Qt::ControlModifier);
        QVERIFY(scene() == after);
        QCOMPARE(table().model()->rowCount(), 2);
        QVERIFY(settle(*m_window));
        QVERIFY(m_window->document().isCurrent());
    }

    void aSavedSceneIsSimulatedByTheCommandLine()
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

    void unsavedTargetsSurvive()
    {
        QTemporaryDir left;
        m_window = newWindow({1400, 1000}, {}, left.path());
        QVERIFY(openAndSettle(*m_window, m_path, takeNineRates));
        QSignalSpy kept(&m_window->recovery(), &Recovery::kept);
        m_window->panel<TargetsPanel>().editor().addTarget();
        QVERIFY(m_window->document().isModified());
        QVERIFY(kept.wait(patience));
        const Session session = readSession(kept.first().first().toString().toStdString());
        QVERIFY(session.source.pings && *session.source.pings == scene());
        QCOMPARE(scene().targets.size(), std::size_t(2));
    }

    void aNewSceneHasNoTargets()
    {
        QSignalSpy opened(&m_window->document(), &Document::opened);
        for (QPushButton *button : panel().findChildren<QPushButton *>())
            if (button->text() == "New scene")
                button->click();
        QVERIFY(opened.wait(patience));
        QVERIFY(scene().targets.empty());
        QCOMPARE(table().model()->rowCount(), 0);
        QVERIFY(sentenceOf(panel()).startsWith("No targets"));
        QCOMPARE(panel().editor().rateUnit(), RateUnit::PerSecond);
        m_window->controller().stop();
    }

    void onTheWelcomePageANewSceneShowsItsPanel()
    {
        const auto window = newWindow();
        QVERIFY(window->welcome().isVisible());
        window->newScene();
        QTRY_VERIFY_WITH_TIMEOUT(window->pingBench().isVisible(), patience);
        QTRY_VERIFY(!window->panel<TargetsPanel>().visibleRegion().isEmpty());
        window->controller().stop();
    }

    void otherPingsAreNotEdited()
    {
        const QString lines = writeFile(
            m_folder, "lines.json", R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 20, "lines": []})");
        QVERIFY(openAndSettle(*m_window, lines));
        QVERIFY(!panel().editor().scene());
        QVERIFY(!buttonOf(panel(), "Place on the map")->isEnabled());
        QVERIFY(sentenceOf(panel()).contains("simulated scenes"));
        QCOMPARE(table().model()->rowCount(), 0);
    }
};

FAINTLINE_WINDOW_TEST(tst_Targets)
#include "tst_Targets.moc"
