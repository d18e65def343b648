#include "base/Error.h"
#include "signal/ArrayRecording.h"
#include "signal/StraightenedRecording.h"
#include "support/recordings.h"
#include "support/test.h"

#include <cmath>
#include <numbers>

using namespace faintline;
using test::amplitudeAt;

namespace {

constexpr double chirpRate = 2000.0;
constexpr Index chirpCount = 60000;

/// 300 + 4 t + 3 sin(2π t/7) Hz at t seconds.
double frequencyAt(double t)
{
    return 300.0 + 4.0 * t + 3.0 * std::sin(2.0 * std::numbers::pi * t / 7.0);
}

double cyclesAt(double t) // its integral
{
    return 300.0 * t + 2.0 * t * t
           + 21.0 / (2.0 * std::numbers::pi) * (1.0 - std::cos(2.0 * std::numbers::pi * t / 7.0));
}

RecordingPointer chirp(bool isComplex)
{
    const auto samples = std::make_shared<std::vector<float>>();
    for (Index n = 0; n < chirpCount; ++n) {
        const double angle = 2.0 * std::numbers::pi * cyclesAt(double(n) / chirpRate);
        samples->push_back(float(std::cos(angle)));
        if (isComplex)
            samples->push_back(float(std::sin(angle)));
    }
    return std::make_shared<ArrayRecording>("chirp", std::shared_ptr<const float>(samples, samples->data()),
                                            ArrayLayout{chirpRate, chirpCount, 1, isComplex, 0.0});
}

FrequencyCurve curve()
{
    const Axis time{"time", "s", 0.0, 0.02, 1501, false};
    std::vector<double> hz;
    for (Index i = 0; i < time.count; ++i)
        hz.push_back(frequencyAt(time.value(double(i))));
    return {time, hz};
}

} // namespace

/// A line that moves, kept at one frequency.
class tst_StraightenedRecording : public QObject
{
    Q_OBJECT

private slots:
    void integratesItsCurve()
    {
        const FrequencyCurve line({"time", "s", 10.0, 2.0, 3, false}, {100.0, 104.0, 104.0});
        QCOMPARE(line.at(5.0), 100.0);
        QCOMPARE(line.at(11.0), 102.0);
        QCOMPARE(line.at(30.0), 104.0);
        QCOMPARE(line.cyclesAt(10.0), 0.0);
        QCOMPARE(line.cyclesAt(11.0), 101.0); // 100 + 2 t, t = 1
        QCOMPARE(line.cyclesAt(12.0), 204.0);
        QCOMPARE(line.cyclesAt(20.0), 204.0 + 8.0 * 104.0);
        QCOMPARE(line.cyclesAt(8.0), -200.0);
        QVERIFY_EXCEPTION_THROWN(FrequencyCurve({"time", "s", 0.0, 1.0, 0, false}, {}), Error);
    }

    void makesALineConstant_data()
    {
        QTest::addColumn<bool>("isComplex");
        QTest::newRow("real") << false;
        QTest::newRow("I/Q") << true;
    }

    /// All of 30 s in one transform: nothing of the amplitude is lost, so the phase has no jump and no curvature is left.
    void makesALineConstant()
    {
        QFETCH(bool, isComplex);
        const StraightenedRecording straight(chirp(isComplex), 0, curve(), 440.0);
        QVERIFY(amplitudeAt(*chirp(isComplex), 440.0, 0, chirpCount) < 0.05);
        const double amplitude = amplitudeAt(straight, 440.0, 0, chirpCount);
        QVERIFY2(std::abs(amplitude - 1.0) < 0.01, qPrintable(QString::number(amplitude)));
    }

    void doesNotDependOnHowItIsRead()
    {
        const StraightenedRecording straight(chirp(false), 0, curve(), 440.0);
        std::vector<float> whole(20000);
        straight.read(0, -100, 20000, whole);
        std::vector<float> part(333);
        straight.read(0, 7001, 333, part);
        for (std::size_t n = 0; n < part.size(); ++n)
            QCOMPARE(part[n], whole[7101 + n]);
        QCOMPARE(whole[50], 0.0f); // before the recording
    }

    void refusesATargetOutsideTheBand()
    {
        QVERIFY_EXCEPTION_THROWN(StraightenedRecording(chirp(false), 0, curve(), 1500.0), Error);
        QVERIFY_EXCEPTION_THROWN(StraightenedRecording(chirp(false), 0, curve(), -1.0), Error);
        QVERIFY_EXCEPTION_THROWN(StraightenedRecording(chirp(false), 1, curve(), 100.0), Error);
    }
};

FAINTLINE_TEST(tst_StraightenedRecording)
#include "tst_StraightenedRecording.moc"
