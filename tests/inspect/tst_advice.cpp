#include "analyse/analyse.h"
#include "inspect/advice.h"
#include "scene/SimulatedRecording.h"
#include "signal/ArrayRecording.h"
#include "support/recordings.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

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

    void whyNotOfAFastLineTellsTheWindow()
    {
        // One bin a frame is 1 Hz in 0.25 s.
        const auto recording = noiseWith({line(20.0, 48.0, 3.5)});
        AnalysisSettings settings;
        settings.spectrogram.windowSeconds = 0.5;
        const auto analysis = analyse(recording, settings);
        const double seconds = 1.5;
        const double hz = 20.0 + 48.0 * seconds;
        const auto advice = adviceOnCell(*analysis, explain(*analysis, seconds, {hz}));
        QVERIFY(advice);
        QCOMPARE(advice->name, std::string("fastLine"));
        QVERIFY2(advice->sentence.find("this model ends at ±4 Hz/s") != std::string::npos, advice->sentence.c_str());
        double drift = 0.0;
        QCOMPARE(std::sscanf(advice->sentence.c_str(), "a line that drifts by %lf Hz/s", &drift), 1);
        QVERIFY2(std::abs(drift - 48.0) < 5.0, advice->sentence.c_str());
        QCOMPARE(advice->remedy, std::string("use a window of 0.13 s"));
        const auto cured = analyse(recording, advice->settings);
        QVERIFY(std::ranges::any_of(cured->tracks, [&](const Track &track) {
            return std::ranges::any_of(track.points, [&](const TrackPoint &point) {
                return std::abs(cured->time().value(double(point.frame)) - seconds) < 0.05
                       && std::abs(cured->grid().axes[0].value(double(point.cell)) - hz) < 12.0;
            });
        }));
        // Beside the line there is none.
        QVERIFY(!adviceOnCell(*analysis, explain(*analysis, seconds, {150.0})));
    }

    void whyNotOfNoiseHasNoFastLines()
    {
        const auto analysis = inWindow(noiseWith({line(100.0, 0.0, 0.0)}), 0.25);
        for (int i = 0; i < 60; ++i) {
            const double seconds = 3.0 + 0.9 * i;
            for (const double hz : {30.0, 90.0, 97.0, 103.0, 160.0}) {
                const auto advice = adviceOnCell(*analysis, explain(*analysis, seconds, {hz}));
                QVERIFY2(!advice || advice->name == "threshold", advice ? advice->sentence.c_str() : "");
            }
        }
    }

    void whyNotOfAFaintLineTellsTheRate()
    {
        const auto recording = noiseWith({line(100.0, 0.0, 0.0)});
        AnalysisSettings settings;
        settings.spectrogram.windowSeconds = 0.25;
        settings.decide.falseAlarmsPerHour = 1e-3;
        const auto analysis = analyse(recording, settings);
        // The first frame of the line whose statistic is above half the threshold.
        std::optional<Advice> advice;
        double seconds = 0.0;
        for (Index frame = 0; frame < 40 && !advice; ++frame) {
            seconds = analysis->time().value(double(frame));
            const Explanation here = explain(*analysis, seconds, {100.0});
            advice = adviceOnCell(*analysis, here);
        }
        QVERIFY(advice);
        QCOMPARE(advice->name, std::string("threshold"));
        const auto cured = analyse(recording, advice->settings);
        QVERIFY(explain(*cured, seconds, {100.0}).displayed >= cured->threshold);
        QVERIFY(cured->threshold < analysis->threshold);
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
