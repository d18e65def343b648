#include "analyse/analyse.h"
#include "inspect/advice.h"
#include "scene/SimulatedRecording.h"
#include "signal/ArrayRecording.h"
#include "support/recordings.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;

namespace {

LineSettings line(double hz, double hzPerSecond, double seconds)
{
    return {.snrDb = 14.0, .durationSeconds = seconds, .frequencyHz = hz, .driftHzPerSecond = hzPerSecond};
}

RecordingPointer noiseWith(std::vector<LineSettings> lines, int seed = 1)
{
    LineScene scene{.sampleRateHz = 400.0, .durationSeconds = 60.0};
    scene.noise.deviation = 1.0;
    scene.seed = seed;
    scene.lines = std::move(lines);
    return std::make_shared<SimulatedRecording>(scene);
}

/// The same 50 samples again and again: frames that begin 50 samples apart are all alike.
RecordingPointer withoutNoise()
{
    const auto samples = std::make_shared<std::vector<float>>();
    for (int i = 0; i < 24'000; ++i)
        samples->push_back(float((i % 50) * (i % 50) % 37) - 18.0f);
    const ArrayLayout layout{.sampleRateHz = 400.0, .sampleCount = std::ssize(*samples)};
    return std::make_shared<ArrayRecording>("pattern", std::shared_ptr<const float>(samples, samples->data()), layout);
}

std::shared_ptr<const Analysis> inWindow(RecordingPointer recording, double seconds)
{
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = seconds;
    return analyse(std::move(recording), settings);
}

} // namespace

/// What is said of an analysis before its numbers are taken at their word, and that the remedy is one.
class tst_advice : public QObject
{
    Q_OBJECT

private slots:
    void noiseNeedsNone()
    {
        for (int seed = 1; seed <= 10; ++seed)
            QVERIFY(advise(*inWindow(noiseWith({}, seed), 0.25)).empty());
    }

    void aLineFasterThanTheModel()
    {
        // One bin a frame is 2 Hz in 0.125 s.
        const auto recording = noiseWith({line(20.0, 22.0, 7.0)});
        const auto advice = adviceOnSlopes(*inWindow(recording, 0.25));
        QVERIFY(advice);
        QVERIFY2(advice->sentence.find("as fast as the model allows, 16 Hz/s") != std::string::npos,
                 advice->sentence.c_str());
        QCOMPARE(advice->remedy, std::string("use a window of 0.13 s"));
        QCOMPARE(advice->settings.spectrogram.windowSeconds, 0.13);
        QVERIFY(!adviceOnSlopes(*analyse(recording, advice->settings)));
    }

    void aLineThatTheModelFollows()
    {
        QVERIFY(!adviceOnSlopes(*inWindow(noiseWith({line(20.0, 8.0, 20.0)}), 0.25)));
        QVERIFY(!adviceOnSlopes(*inWindow(noiseWith({line(50.0, 0.0, 0.0)}), 0.25)));
    }

    void linesTooClose()
    {
        // A cell is 2 Hz.
        const auto recording = noiseWith({line(100.0, 0.0, 0.0), line(105.0, 0.0, 0.0)});
        const auto advice = adviceOnCloseLines(*inWindow(recording, 0.5));
        QVERIFY(advice);
        QVERIFY2(advice->sentence.find("1 pair of tracks runs less than 3 cells apart, e.g. 5") != std::string::npos,
                 advice->sentence.c_str());
        QVERIFY(std::abs(advice->settings.spectrogram.windowSeconds - 0.8) < 0.03);
        QVERIFY(!adviceOnCloseLines(*analyse(recording, advice->settings)));
    }

    void windowsThatWereAskedAreNotAdvised()
    {
        const auto analysis = analyse(noiseWith({line(100.0, 0.0, 0.0), line(105.0, 0.0, 0.0)}), {});
        const double own = analysis->frames->spectrogram()->windowSeconds();
        const auto &others = analysis->others;
        QVERIFY(!others.empty());
        for (const auto &other : others)
            QVERIFY(isAsked(*analysis, other->frames->spectrogram()->windowSeconds()));
        QVERIFY(!isAsked(*analysis, 1e3 * own) && !isAsked(*analysis, 1e-3 * own));
        QVERIFY(!isAsked(*inWindow(noiseWith({}, 1), 0.25), 0.125));
    }

    void stopBandsAreNamedAndNotCounted()
    {
        const auto analysis = inWindow(test::filteredNoise(300.0), 0.5);
        const auto advice = adviceOnStopBands(*analysis);
        QVERIFY(advice);
        QVERIFY2(advice->sentence.find(" … 500 Hz is not searched: it lies 3") != std::string::npos,
                 advice->sentence.c_str());
        const double low = advice->settings.selection.lowHz;
        QVERIFY2(low > 300.0 && low < 350.0, advice->sentence.c_str());
        QCOMPARE(advice->settings.selection.highHz, 500.0);
        // 500 Hz in bins of 1 Hz, four frames a second.
        const double searched = analysis->cellFramesPerHour / (4.0 * 3600.0);
        QVERIFY2(std::abs(searched - low) < 2.0, qPrintable(QString::number(searched)));
        QVERIFY(!adviceOnStopBands(*analyse(test::filteredNoise(300.0), advice->settings)));
        QVERIFY(!adviceOnStopBands(*inWindow(noiseWith({}, 1), 0.25)));
    }

    void distancesAreWrittenPlainly()
    {
        LineScene scene; // a cell is 50 Hz
        scene.sampleRateHz = 4000.0;
        scene.durationSeconds = 20.0;
        scene.noise.deviation = 1.0;
        for (const double hz : {600.0, 720.0}) {
            LineSettings settings{.snrDb = 14.0, .referenceSeconds = 0.02, .durationSeconds = 20.0, .frequencyHz = hz};
            scene.lines.push_back(settings);
        }
        const auto advice = adviceOnCloseLines(*inWindow(std::make_shared<SimulatedRecording>(scene), 0.02));
        QVERIFY(advice);
        QVERIFY2(advice->sentence.find("e.g. 1") != std::string::npos
                     && advice->sentence.find("e+") == std::string::npos,
                 advice->sentence.c_str());
    }

    void linesFarEnoughApart()
    {
        QVERIFY(!adviceOnCloseLines(*inWindow(noiseWith({line(100.0, 0.0, 0.0), line(110.0, 0.0, 0.0)}), 0.5)));
    }

    /// In the window that would separate them, they would drift faster than the model allows.
    void noLongerWindowForFastLines()
    {
        const auto recording = noiseWith({line(20.0, 2.5, 50.0), line(25.0, 2.5, 50.0)});
        QVERIFY(!adviceOnCloseLines(*inWindow(recording, 0.5)));
    }

    void noNoise()
    {
        const auto advice = adviceOnConstantCells(*inWindow(withoutNoise(), 0.25));
        QVERIFY(advice);
        QVERIFY(advice->remedy.empty());
        QCOMPARE(advise(*inWindow(withoutNoise(), 0.25)).front().name, std::string("constantCells"));
    }

    void strongLinesInNoise() { QVERIFY(!adviceOnConstantCells(*inWindow(noiseWith({line(50.0, 0.0, 0.0)}), 0.25))); }
};

FAINTLINE_TEST(tst_advice)
#include "tst_advice.moc"
