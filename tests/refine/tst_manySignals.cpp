#include "support/manySignals.h"
#include "support/test.h"

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

FAINTLINE_TEST(tst_manySignals)
#include "tst_manySignals.moc"
