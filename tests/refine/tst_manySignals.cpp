#include "support/manySignals.h"
#include "support/test.h"

#include "analyse/analyse.h"
#include "base/Random.h"
#include "scene/SimulatedRecording.h"
#include "support/lines.h"

#include <algorithm>
#include <map>

using namespace faintline;

/// Signals beside each other, crossing and meeting: one clean track for each. The whole table, with more seeds, is
/// printed by faintline-many-signals (tests/bench/many_signals.cpp).
class tst_manySignals : public QObject
{
    Q_OBJECT

private slots:
    void oneTrackForEach_data();
    void oneTrackForEach();
    void whistlesKeepTheirTracks();
    void tracksEndWithTheirLinesBesideOthers();
};

void tst_manySignals::oneTrackForEach_data()
{
    QTest::addColumn<double>("coverage"); // of the worse signal, as are all
    QTest::addColumn<double>("single");
    QTest::addColumn<double>("error"); // of 90 %, cells
    const auto row = [](const char *scene, double coverage, double single, double error) {
        QTest::newRow(scene) << coverage << single << error;
    };
    row("+30 and +6 dB, 3.0 cells", 0.96, 0.96, 0.4);
    row("+30 and +6 dB, 4.0 cells", 0.96, 0.96, 0.4);
    row("+10 and +10 dB, 2.5 cells", 0.95, 0.9, 0.4);
    row("crossing +6 and +6 dB, +0.0 and +1.0 Hz/s", 0.96, 0.93, 0.4);
    row("crossing +12 and +6 dB, +0.0 and +1.0 Hz/s", 0.96, 0.95, 0.4);
    row("crossing +12 and +12 dB, +0.0 and +1.0 Hz/s", 0.96, 0.9, 0.4);
}

void tst_manySignals::oneTrackForEach()
{
    QFETCH(double, coverage);
    QFETCH(double, single);
    QFETCH(double, error);
    constexpr int seed = 201;
    const test::SignalScene scene = test::signalScene(QTest::currentDataTag(), seed);
    const test::SceneScore score = test::scoreOf(scene, *test::analysisOf(scene, seed));
    const test::SignalScore worst = score.worst();
    const QByteArray found = QByteArray("coverage %1, single %2, fragments %3, swaps %4, false %5, error %6");
    const QString words = QString::fromLatin1(found)
                              .arg(worst.coverage)
                              .arg(worst.single)
                              .arg(worst.fragments)
                              .arg(score.swaps)
                              .arg(score.falseTracks)
                              .arg(worst.error);
    QVERIFY2(worst.coverage >= coverage, qPrintable(words));
    QVERIFY2(worst.single >= single, qPrintable(words));
    QVERIFY2(worst.fragments == 1, qPrintable(words));
    QVERIFY2(score.swaps == 0, qPrintable(words));
    QVERIFY2(score.falseTracks == 0, qPrintable(words));
    QVERIFY2(worst.error <= error, qPrintable(words));
}

void tst_manySignals::whistlesKeepTheirTracks()
{
    constexpr int seed = 201;
    const test::SignalScene scene = test::signalScene("20 whistles", seed);
    const test::SceneScore score = test::scoreOf(scene, *test::analysisOf(scene, seed));
    const test::SignalScore mean = score.mean();
    QVERIFY2(mean.coverage >= 0.96, qPrintable(QString::number(mean.coverage)));
    QVERIFY2(mean.single >= 0.85, qPrintable(QString::number(mean.single)));
    QVERIFY2(score.precision >= 0.95, qPrintable(QString::number(score.precision)));
}

// Lines four resolution cells apart that begin and end at any time: a path does not go on along a neighbour.
void tst_manySignals::tracksEndWithTheirLinesBesideOthers()
{
    constexpr double window = 0.5;
    int tracks = 0;
    int alongSeveral = 0;
    for (const int seed : {1, 2, 3}) {
        LineScene scene = test::scene(1000.0, 60.0, seed);
        Random random(std::uint64_t(seed), 7);
        for (int k = 0; k < 8; ++k) {
            const double start = 30.0 * random.uniform();
            const double seconds = 15.0 + 13.0 * random.uniform();
            scene.lines.push_back(test::line(100.0 + 8.0 * k + random.uniform(), 0.0, start, seconds, 18.0, window));
        }
        AnalysisSettings settings;
        settings.spectrogram.windowSeconds = window;
        const auto analysis = analyse(std::make_shared<SimulatedRecording>(scene), settings);
        for (const Track &track : analysis->tracks) {
            std::map<std::size_t, int> points; // by the line
            for (const std::size_t i : track.presentPoints())
                for (std::size_t k = 0; k < scene.lines.size(); ++k)
                    if (std::abs(analysis->grid().axes.back().value(track.smoothed[i].position)
                                 - scene.lines[k].frequencyHz)
                        < 1.5)
                        ++points[k];
            ++tracks;
            alongSeveral += std::ranges::count_if(points, [](const auto &line) { return line.second >= 4; }) > 1;
        }
    }
    const QString found = QString("%1 of %2").arg(alongSeveral).arg(tracks);
    QVERIFY2(tracks >= 21 && tracks <= 27, qPrintable(found));
    QVERIFY2(alongSeveral <= 5, qPrintable(found));
}

FAINTLINE_TEST(tst_manySignals)
#include "tst_manySignals.moc"
