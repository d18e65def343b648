#include "analyse/analyse.h"
#include "base/Error.h"
#include "plan/slopeUnit.h"
#include "scene/SimulatedRecording.h"
#include "support/errors.h"
#include "support/frames.h"
#include "support/test.h"

using namespace faintline;

namespace {

RecordingPointer recordingOf(double rateHz, double seconds)
{
    LineScene scene{.sampleRateHz = rateHz, .durationSeconds = seconds};
    scene.noise.deviation = 1.0;
    return std::make_shared<SimulatedRecording>(scene);
}

AnalysisSettings inHertz(double lowest, double highest)
{
    AnalysisSettings settings;
    settings.model.slopeUnit = SlopeUnit::HzPerSecond;
    settings.model.lowestSlope = lowest;
    settings.model.highestSlope = highest;
    return settings;
}

} // namespace

/// Slopes in Hz/s against those in bins a frame.
class tst_slopeUnit : public QObject
{
    Q_OBJECT

private slots:
    void aBinAFrameIsTheFramesOwn_data()
    {
        QTest::addColumn<double>("rate");
        QTest::addColumn<double>("window");
        QTest::addColumn<int>("steps");
        QTest::addColumn<int>("bins");
        QTest::newRow("round") << 1000.0 << 0.25 << 2 << 2;
        QTest::newRow("automatic") << 1000.0 << 0.0 << 2 << 2;
        QTest::newRow("length without small factors") << 977.0 << 0.263 << 3 << 3;
        QTest::newRow("two samples") << 100.0 << 0.02 << 4 << 1;
    }

    void aBinAFrameIsTheFramesOwn()
    {
        QFETCH(double, rate);
        QFETCH(double, window);
        QFETCH(int, steps);
        QFETCH(int, bins);
        const RecordingPointer recording = recordingOf(rate, 20.0);
        AnalysisSettings settings;
        settings.spectrogram.windowSeconds = window;
        settings.spectrogram.stepsPerWindow = steps;
        settings.spectrogram.binsPerCell = bins;
        const Spectrogram spectrogram(recording, settings.spectrogram);
        QCOMPARE(hzPerSecondOfABinAFrame(settings, recording->info()),
                 spectrogram.frequency().step / spectrogram.time().step);
        if (spectrogram.frequency().count < 64)
            return;
        // The fundamental's bins are as fine as its highest multiple needs them.
        settings.family = {FamilySettings::Relation::Harmonics, {1.0, 2.0, 3.0}, FamilySettings::Present::Together};
        const Axis fundamental = familyAxis(settings.family, spectrogram.frequency());
        QCOMPARE(hzPerSecondOfABinAFrame(settings, recording->info()), fundamental.step / spectrogram.time().step);
    }

    void slopesAreTakenOutwards()
    {
        // Window 0.25 s, k_t = k_f = 2: 2 Hz a bin, 0.125 s a frame, 16 Hz/s a bin a frame, 2 Hz/s the next slope.
        const RecordingPointer recording = recordingOf(1024.0, 60.0);
        AnalysisSettings settings = inHertz(-3.0, 4.1);
        settings.spectrogram.windowSeconds = 0.25;
        const AnalysisSettings inBins = withSlopesInBins(settings, recording->info());
        QCOMPARE(inBins.model.slopeUnit, SlopeUnit::BinsPerFrame);
        QCOMPARE(inBins.model.lowestSlope, -0.25);
        QCOMPARE(inBins.model.highestSlope, 0.375);
        checkSettings(inBins);
        const MarkovModel model = makeModel(inBins.model, {{{"f", "Hz", 0.0, 2.0, 100, false}}});
        QCOMPARE(model.space.axes().front().rateCount, 6);
        AnalysisSettings already;
        already.model.lowestSlope = -0.5;
        QVERIFY(withSlopesInBins(already, recording->info()) == already);
    }

    void thereAndBackIsTheSame()
    {
        for (const double hz : {0.003, 0.7, 16.0, 15.384615, 25000.0})
            for (const ModelSettings &law : {ModelSettings(), laws::billon(), laws::steady(), laws::glide()}) {
                const ModelSettings inHz = withSlopesIn(SlopeUnit::HzPerSecond, law, hz);
                QVERIFY(inHz.highestSlope == 0.0 || std::abs(inHz.highestSlope / (law.highestSlope * hz) - 1.0) < 1e-3);
                QVERIFY(withSlopesIn(SlopeUnit::BinsPerFrame, inHz, hz) == law);
            }
    }

    // The window that is chosen for a recording says what a bin a frame is.
    void followsTheAutomaticWindow()
    {
        const RecordingPointer recording = recordingOf(1024.0, 60.0);
        const Spectrogram spectrogram(recording, {});
        const double hz = spectrogram.frequency().step / spectrogram.time().step;
        const AnalysisSettings inBins = withSlopesInBins(inHertz(-0.5 * hz, 0.5 * hz), recording->info());
        QCOMPARE(inBins.model.lowestSlope, -0.5);
        QCOMPARE(inBins.model.highestSlope, 0.5);
    }

    void hertzPerSecondNeedsAFrequencyAxis()
    {
        const AnalysisSettings settings = inHertz(-1.0, 1.0);
        checkSettings(settings);
        const auto frames = test::framesOf(20, std::vector<float>(40, 1.0f));
        const Axis &axis = frames->grid().axes.front();
        const double slope = axis.step / frames->time().step; // a bin a frame
        const auto analysis = analyse(frames, inHertz(-slope, slope));
        QCOMPARE(analysis->settings.model.lowestSlope, -1.0);
        QCOMPARE(analysis->settings.model.highestSlope, 1.0);
        const Grid range{{{"range", "m", 0.0, 1.0, 20, false}}};
        const auto pings = std::make_shared<FrameArray>(frames->time(), range, std::vector<float>(40, 1.0f));
        const std::string said = test::errorOf([&] { analyse(pings, settings); });
        QVERIFY2(said.starts_with("model.slopeUnit = hzPerSecond: needs a recording, or frames over frequency"),
                 said.c_str());
    }

    void tooSteepIsRefused()
    {
        const RecordingPointer recording = recordingOf(1024.0, 60.0);
        AnalysisSettings settings = inHertz(-1.0, 1e6);
        settings.spectrogram.windowSeconds = 0.25;
        QVERIFY_THROWS_EXCEPTION(Error, checkSettings(withSlopesInBins(settings, recording->info())));
    }
};

FAINTLINE_TEST(tst_slopeUnit)
#include "tst_slopeUnit.moc"
