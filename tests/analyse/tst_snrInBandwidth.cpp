#include "analyse/analyse.h"
#include "analyse/events.h"
#include "scene/SimulatedRecording.h"
#include "support/lines.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;

/// SNR against the noise in a given bandwidth.
class tst_snrInBandwidth : public QObject
{
    Q_OBJECT

private slots:
    void noiseBandwidthsOfWindows()
    {
        QVERIFY(std::abs(noiseBandwidthCells(WindowShape::Rectangular) - 1.0) < 1e-3);
        QVERIFY(std::abs(noiseBandwidthCells(WindowShape::Hann) - 1.5) < 1e-3);
        QVERIFY(std::abs(noiseBandwidthCells(WindowShape::Blackman) - 1.7268) < 2e-3); // Harris 1978: 1.73
        QVERIFY(std::abs(snrChangeDb(1.5, {.windowSeconds = 1.0})) < 0.01);
        QVERIFY(std::abs(snrChangeDb(2500.0, {.windowSeconds = 1.0}) + 10.0 * std::log10(2500.0 / 1.5)) < 0.01);
    }

    /// A sinusoid of amplitude a in white noise of deviation σ sampled at f has a²f/(4σ²) in 1 Hz.
    void doesNotDependOnTheWindow()
    {
        LineScene scene{.sampleRateHz = 400.0, .durationSeconds = 120.0};
        scene.lines = {{.snrDb = 12.0, .frequencyHz = 90.0}};
        const auto recording = std::make_shared<SimulatedRecording>(scene);
        const double amplitude = recording->truth().lines.front().amplitude;
        const double in1Hz = 10.0
                             * std::log10(amplitude * amplitude * scene.sampleRateHz
                                          / (4.0 * scene.noise.deviation * scene.noise.deviation));
        for (const double seconds : {0.25, 0.5, 1.0}) {
            AnalysisSettings settings;
            settings.spectrogram.windowSeconds = seconds;
            const auto analysis = analyse(recording, settings);
            const Event event = chosenEvent(*analysis, 0);
            const double own = event.snrDb + snrChangeDb(1.0, analysis->frames->geometry());
            QVERIFY2(std::abs(own - in1Hz) < 0.8, QByteArray::number(own) + " " + QByteArray::number(in1Hz));
        }
    }

    /// The line beside the sweeps is found with a window four times as long as that which the sweeps choose.
    void doesNotDependOnTheWindowThatFoundIt()
    {
        LineScene scene = test::sweeps();
        scene.lines.push_back(test::line(3000.3, 0.0, 0.0, scene.durationSeconds, -4.0, 0.025));
        const auto analysis = analyse(std::make_shared<SimulatedRecording>(scene), {});
        const double shown = analysis->frames->geometry().windowSeconds;
        const double in1Hz = -4.0 - 10.0 * std::log10(0.025); // the SNR is that in a rectangular window of 25 ms
        int others = 0;
        for (const Event &event : events(*analysis))
            if (event.windowSeconds > 2.0 * shown) {
                ++others;
                const double own = event.snrDb + snrChangeDb(1.0, analysis->frames->geometry());
                QVERIFY2(std::abs(own - in1Hz) < 1.5, QByteArray::number(own) + " " + QByteArray::number(in1Hz));
            }
        QCOMPARE(others, 1);
    }
};

FAINTLINE_TEST(tst_snrInBandwidth)
#include "tst_snrInBandwidth.moc"
