#include "analysis/lineHeight.h"
#include "base/Error.h"
#include "recording/ArrayRecording.h"
#include "recording/SimulatedRecording.h"

#include <QtTest>

#include <cmath>
#include <limits>

using namespace faintline;

/// One line in one long transform.
class tst_lineHeight : public QObject
{
    Q_OBJECT

private slots:
    void findsTheLineOfOneTransform();
    void takesABandWiderThanTheRecordings();
    void isInfiniteOverSilence();
    void refusesWhatIsTooShort();
};

void tst_lineHeight::findsTheLineOfOneTransform()
{
    LineScene scene;
    scene.sampleRateHz = 500.0;
    scene.durationSeconds = 100.0;
    scene.noise.deviation = 0.1;
    scene.lines = {LineSettings{.snrDb = 0.0, .referenceSeconds = 1.0, .frequencyHz = 80.125}};
    const SimulatedRecording recording(scene);
    const LineHeight height = lineHeight(recording, {0, 0.0, 100.0, 80.0, 5.0});
    QVERIFY2(std::abs(height.hz - 80.125) < 0.005, qPrintable(QString::number(height.hz)));
    // 0 dB in 1 s, 100 s, 1.76 dB for the Hann window, and the median of noise lies 1.59 dB below its mean.
    QVERIFY2(std::abs(height.db - (20.0 - 1.76 + 1.59)) < 1.5, qPrintable(QString::number(height.db)));
}

/// Nothing is read beyond what there is: the band ends at half the rate.
void tst_lineHeight::takesABandWiderThanTheRecordings()
{
    LineScene scene;
    scene.sampleRateHz = 500.0;
    scene.durationSeconds = 2.0;
    scene.noise.deviation = 0.1;
    const LineHeight height = lineHeight(SimulatedRecording(scene), {0, 0.0, 2.0, 80.0, 1e6});
    QVERIFY(std::isfinite(height.db) && std::abs(height.hz - 80.0) <= 250.0);
}

void tst_lineHeight::isInfiniteOverSilence()
{
    const auto samples = std::make_shared<std::vector<float>>(1000, 0.0f);
    const ArrayRecording silent("silence", std::shared_ptr<const float>(samples, samples->data()),
                                ArrayLayout{100.0, 1000, 1, false, 0.0});
    QVERIFY(!std::isfinite(lineHeight(silent, {0, 0.0, 10.0, 20.0, 5.0}).db));
}

void tst_lineHeight::refusesWhatIsTooShort()
{
    LineScene scene;
    scene.sampleRateHz = 500.0;
    scene.durationSeconds = 2.0;
    const SimulatedRecording recording(scene);
    for (const Stretch &stretch :
         {Stretch{0, 0.0, 0.01, 80.0, 5.0}, Stretch{0, 1.0, 1.0, 80.0, 5.0}, Stretch{0, 1.5, 1.0, 80.0, 5.0},
          Stretch{0, 0.0, 2.0, 80.0, 0.0}, Stretch{0, 0.0, 2.0, 80.0, std::numeric_limits<double>::quiet_NaN()}})
        QVERIFY_EXCEPTION_THROWN(lineHeight(recording, stretch), Error);
}

QTEST_APPLESS_MAIN(tst_lineHeight)
#include "tst_lineHeight.moc"
