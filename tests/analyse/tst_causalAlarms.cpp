#include "analyse/analyse.h"
#include "scene/SimulatedRecording.h"
#include "support/test.h"

#include <array>
#include <cmath>
#include <numeric>

using namespace faintline;

/// False alarms over a causal background: as many as ordered, from the first minute on.
class tst_causalAlarms : public QObject
{
    Q_OBJECT

private slots:
    void startsAreLikeTheRest_data();
    void startsAreLikeTheRest();
};

void tst_causalAlarms::startsAreLikeTheRest_data()
{
    QTest::addColumn<double>("perHour");
    QTest::addColumn<int>("starts");
    QTest::addColumn<double>("tolerance"); // of the number ordered
    QTest::newRow("five an hour") << 5.0 << 800 << 0.2;
    QTest::newRow("sixty an hour") << 60.0 << 400 << 0.12;
}

// 800 and 400 starts of three minutes: 200 and 1200 are ordered, of which chance leaves 7 and 3 percent. The three
// minutes are alike to chi-squared with two degrees of freedom, 5 %.
void tst_causalAlarms::startsAreLikeTheRest()
{
    QFETCH(double, perHour);
    QFETCH(int, starts);
    QFETCH(double, tolerance);
    std::array<double, 3> minutes{};
    for (int seed = 7001; seed <= 7000 + starts; ++seed) {
        LineScene scene;
        scene.sampleRateHz = 1000.0;
        scene.durationSeconds = 180.0;
        scene.noise.deviation = 1.0;
        scene.seed = seed;
        AnalysisSettings settings;
        settings.noise.causal = true;
        settings.spectrogram.windowSeconds = 0.25;
        settings.decide.falseAlarmsPerHour = perHour;
        const auto analysis =
            analyse(std::make_shared<SimulatedRecording>(scene), settings, {.depth = AnalysisDepth::Tracks});
        for (const Track &track : analysis->tracks) {
            const double seconds = analysis->time().value(double(track.detectFrame));
            ++minutes[std::min<std::size_t>(2, std::size_t(seconds / 60.0))];
        }
    }
    const double all = std::accumulate(minutes.begin(), minutes.end(), 0.0);
    const double expected = all / 3.0;
    double chiSquared = 0.0;
    for (const double count : minutes)
        chiSquared += (count - expected) * (count - expected) / expected;
    const QString counts = QString("%1, %2, %3 in the minutes").arg(minutes[0]).arg(minutes[1]).arg(minutes[2]);
    qInfo("%s", qPrintable(counts));
    const double ordered = 0.05 * starts * perHour;
    QVERIFY2(std::abs(all - ordered) <= tolerance * ordered, qPrintable(counts));
    QVERIFY2(chiSquared < 5.99, qPrintable(counts));
}

FAINTLINE_TEST(tst_causalAlarms)
#include "tst_causalAlarms.moc"
