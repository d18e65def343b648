#include "analyse/analyse.h"
#include "scene/SimulatedRecording.h"
#include "support/test.h"

#include <array>
#include <numeric>

using namespace faintline;

/// False alarms of a recording's beginning: as many as later on.
class tst_startingUp : public QObject
{
    Q_OBJECT

private slots:
    void theFirstMinuteIsLikeTheRest();
};

// 400 recordings of four minutes at one false alarm a minute; chi-squared with one degree of freedom, 5 %. With these
// seeds the minutes hold 384, 387, 407 and 392.
void tst_startingUp::theFirstMinuteIsLikeTheRest()
{
    std::array<double, 4> minutes{};
    for (int seed = 5001; seed <= 5400; ++seed) {
        LineScene scene;
        scene.sampleRateHz = 1000.0;
        scene.durationSeconds = 240.0;
        scene.noise.deviation = 1.0;
        scene.seed = seed;
        AnalysisSettings settings;
        settings.spectrogram.windowSeconds = 0.25;
        settings.decide.falseAlarmsPerHour = 60.0;
        const auto analysis = analyse(std::make_shared<SimulatedRecording>(scene), settings);
        for (const Track &track : analysis->tracks) {
            const double seconds = analysis->time().value(double(track.detectFrame));
            ++minutes[std::min<std::size_t>(3, std::size_t(seconds / 60.0))];
        }
    }
    const double all = std::accumulate(minutes.begin(), minutes.end(), 0.0);
    QVERIFY2(all > 1100.0 && all < 2200.0, qPrintable(QString::number(all)));
    const double expected = all / 4.0;
    const double difference = minutes[0] - expected;
    const double chiSquared = difference * difference / expected + difference * difference / (all - expected);
    QVERIFY2(chiSquared < 3.84,
             qPrintable(QString("%1 in the first minute, %2 expected").arg(minutes[0]).arg(expected)));
}

FAINTLINE_TEST(tst_startingUp)
#include "tst_startingUp.moc"
