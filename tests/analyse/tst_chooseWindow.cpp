#include "analyse/analyse.h"
#include "analyse/chooseWindow.h"
#include "scene/SimulatedRecording.h"
#include "support/lines.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;
using namespace faintline::test;

namespace {

/// Lines that stand still. The automatic window is 0.2 s.
LineScene constants()
{
    LineScene result = scene(4000.0, 32.0, 8);
    for (int i = 0; i < 6; ++i)
        result.lines.push_back(line(200.0 + 250.0 * i, 0.0, 0.0, 32.0, 8.0, 0.2));
    return result;
}

std::shared_ptr<const Analysis> analysed(const LineScene &lines, const AnalysisSettings &settings = {},
                                         const Analysis *previous = nullptr)
{
    return analyse(std::make_shared<SimulatedRecording>(lines), settings, {.previous = previous});
}

double windowOf(const Analysis &analysis)
{
    return analysis.choice->trials[analysis.choice->chosen].windowSeconds;
}

} // namespace

/// The window chosen by what it follows of the signals that others found.
class tst_chooseWindow : public QObject
{
    Q_OBJECT

private slots:
    void whichSettingsLeaveItOpen_data();
    void whichSettingsLeaveItOpen();
    void onNoiseTheAutomaticOneStays();
    void sweepsTakeAShorterOne();
    void linesThatStandStillTakeALongerOne();
    void noneIsLongerThanMemoryBears();
    void noWindowSuitsNoise();
    void aChangeOfTheThresholdKeepsIt();
    void itsWords();
};

void tst_chooseWindow::whichSettingsLeaveItOpen_data()
{
    QTest::addColumn<QString>("presetName");
    QTest::addColumn<QString>("setting");
    QTest::addColumn<QString>("value");
    QTest::addColumn<bool>("isOpen");
    QTest::newRow("defaults") << "lines"
                              << "decide.falseAlarmsPerHour"
                              << "10" << true;
    QTest::newRow("strong") << "strong"
                            << "model.snr"
                            << "1" << true;
    QTest::newRow("a window") << "lines"
                              << "spectrogram.windowSeconds"
                              << "0.5" << false;
    QTest::newRow("a law") << "whistles"
                           << "model.snr"
                           << "1" << false;
    QTest::newRow("Billon's") << "billon"
                              << "model.snr"
                              << "1" << false;
    QTest::newRow("a slope") << "lines"
                             << "model.highestSlope"
                             << "2" << false;
    QTest::newRow("another detector") << "lines"
                                      << "detector.kind"
                                      << "integrator" << false;
    QTest::newRow("no second look") << "lines"
                                    << "track.bothWays"
                                    << "false" << false;
    QTest::newRow("pings") << "sonar"
                           << "model.snr"
                           << "1" << false;
}

void tst_chooseWindow::whichSettingsLeaveItOpen()
{
    QFETCH(QString, presetName);
    QFETCH(QString, setting);
    QFETCH(QString, value);
    AnalysisSettings settings = preset(presetName.toStdString()).settings;
    setSetting(settings, setting.toStdString(), value.toStdString());
    QTEST(leavesWindowToRecording(settings), "isOpen");
}

void tst_chooseWindow::onNoiseTheAutomaticOneStays()
{
    AnalysisSettings settings;
    settings.decide.falseAlarmsPerHour = 600.0; // false alarms there are, but none that is sure
    const auto recording = std::make_shared<SimulatedRecording>(scene(2000.0, 60.0, 3));
    const auto chosen = analyse(recording, settings);
    const auto plain = analyse(recording, settings);
    QCOMPARE(chosen->choice->chosen, chosen->choice->automatic);
    QVERIFY(chosen->settings == settings);
    QCOMPARE(chosen->tracks.size(), plain->tracks.size());
    for (std::size_t i = 0; i < plain->tracks.size(); ++i)
        QCOMPARE(chosen->tracks[i].peakStatistic, plain->tracks[i].peakStatistic);
    QVERIFY(chosen->statistic && chosen->input);
}

void tst_chooseWindow::sweepsTakeAShorterOne()
{
    const auto analysis = analysed(sweeps());
    QVERIFY2(windowOf(*analysis) < 0.03, qPrintable(QString::number(windowOf(*analysis))));
    QVERIFY(analysis->settings.model.highestSlope == laws::glide().highestSlope);
    QVERIFY(analysis->statistic && analysis->input && !analysis->checkpoints.isEmpty());
    QVERIFY(analysis->answers(AnalysisSettings()));
    // One track each; two at most come of noise.
    QVERIFY2(analysis->tracks.size() >= 8 && analysis->tracks.size() <= 10,
             qPrintable(QString::number(analysis->tracks.size())));
}

void tst_chooseWindow::linesThatStandStillTakeALongerOne()
{
    const auto analysis = analysed(constants());
    QVERIFY2(windowOf(*analysis) > 0.7, qPrintable(QString::number(windowOf(*analysis))));
    QVERIFY(analysis->settings.model == AnalysisSettings().model);
    QVERIFY(analysis->tracks.size() >= 6 && analysis->tracks.size() <= 8);
}

/// A line that stands still for an hour asks for ever longer ones: after 128 s comes one of 4.1 million samples.
void tst_chooseWindow::noneIsLongerThanMemoryBears()
{
    LineScene still = scene(8000.0, 4200.0, 1);
    still.lines.push_back(line(1000.0, 0.0, 0.0, 4200.0, 10.0, 2.0));
    AnalysisSettings settings;
    settings.selection.lowHz = 990.0;
    settings.selection.highHz = 1010.0;
    const auto analysis = analysed(still, settings);
    QCOMPARE(analysis->choice->trials.size(), std::size_t(5)); // with half of it
    QCOMPARE(windowOf(*analysis), 128.0);
}

/// Bursts of noise have more of their energy the shorter the window is: no reason to choose one.
void tst_chooseWindow::noWindowSuitsNoise()
{
    LineScene bursts = scene(2000.0, 60.0, 5);
    for (int burst = 0; burst < 40; ++burst)
        bursts.lines.push_back(line(100.0 + 20.0 * burst, 0.0, 0.5 + 1.4 * burst, 0.004, 40.0, 0.004));
    const auto analysis = analysed(bursts);
    QCOMPARE(analysis->choice->chosen, analysis->choice->automatic);
}

void tst_chooseWindow::aChangeOfTheThresholdKeepsIt()
{
    const auto recording = std::make_shared<SimulatedRecording>(sweeps());
    const auto first = analyse(recording, {});
    AnalysisSettings settings;
    settings.decide.falseAlarmsPerHour = 10.0;
    const auto second = analyse(recording, settings, {.previous = first.get()});
    QCOMPARE(windowOf(*second), windowOf(*first));
    QVERIFY(second->frames == first->frames); // nothing was tried again
    QCOMPARE(second->settings.decide.falseAlarmsPerHour, 10.0);
    QVERIFY(second->answers(settings) && !second->answers({}));
    QVERIFY(second->threshold < first->threshold);

    settings.model.snr = 1.0; // what is previewed before a window is chosen anew
    const AnalysisSettings previewed = inWindowOf(*second, settings);
    QCOMPARE(previewed.spectrogram.windowSeconds, second->settings.spectrogram.windowSeconds);
    QVERIFY(previewed.model.highestSlope == laws::glide().highestSlope && previewed.model.snr == 1.0);
    settings.spectrogram.windowSeconds = 0.5;
    QVERIFY(inWindowOf(*second, settings) == settings);
}

void tst_chooseWindow::itsWords()
{
    WindowChoice choice;
    choice.trials = {{{}, 0.0025, 60, 1.15}, {{}, 0.01, 125, 0.11}, {{}, 0.04, 202, 0.9}, {{}, 0.16, 20, std::nan("")}};
    choice.automatic = 2;
    choice.chosen = 1;
    QCOMPARE(windowChoiceWords(choice),
             std::string("window 0.01 s chosen; one of 0.04 s would follow 11 % of the energy along its tracks"));
    choice.chosen = 3;
    QCOMPARE(windowChoiceWords(choice),
             std::string("window 0.16 s chosen; it follows 90 % of the energy along the tracks of 0.04 s"));
    choice.chosen = 2;
    QCOMPARE(windowChoiceWords(choice), std::string("window 0.04 s (automatic)"));
    choice.fromOthers = 1;
    QCOMPARE(windowChoiceWords(choice), std::string("window 0.04 s (automatic); 1 signal from other windows"));
    choice.chosen = 1;
    choice.fromOthers = 3;
    QCOMPARE(windowChoiceWords(choice),
             std::string("window 0.01 s chosen; one of 0.04 s would follow 11 % of the energy along its tracks; "
                         "3 signals from other windows"));
}

FAINTLINE_TEST(tst_chooseWindow)
#include "tst_chooseWindow.moc"
