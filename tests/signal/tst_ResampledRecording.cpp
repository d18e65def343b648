#include "base/Error.h"
#include "signal/ArrayRecording.h"
#include "signal/StraightenedRecording.h"
#include "support/errors.h"
#include "support/recordings.h"
#include "support/test.h"

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

using namespace faintline;
using test::amplitudeAt;

namespace {

constexpr double resampledRate = 2000.0;
constexpr Index resampledCount = 60000;

/// Turns of a fundamental of 60 + 0.4 t + 2 sin(2π t/7) Hz at t seconds.
double cyclesAt(double t)
{
    return 60.0 * t + 0.2 * t * t + 7.0 / std::numbers::pi * (1.0 - std::cos(2.0 * std::numbers::pi * t / 7.0));
}

FrequencyCurve curve()
{
    const Axis time{"time", "s", 0.0, 0.02, 1501, false};
    std::vector<double> hz;
    for (Index i = 0; i < time.count; ++i) {
        const double t = time.value(double(i));
        hz.push_back(60.0 + 0.4 * t + 2.0 * std::sin(2.0 * std::numbers::pi * t / 7.0));
    }
    return {time, hz};
}

RecordingPointer made(bool isComplex, const std::function<std::complex<double>(double)> &at)
{
    const auto samples = std::make_shared<std::vector<float>>();
    for (Index n = 0; n < resampledCount; ++n) {
        const std::complex<double> value = at(double(n) / resampledRate);
        samples->push_back(float(value.real()));
        if (isComplex)
            samples->push_back(float(value.imag()));
    }
    return std::make_shared<ArrayRecording>("family", std::shared_ptr<const float>(samples, samples->data()),
                                            ArrayLayout{resampledRate, resampledCount, 1, isComplex, 0.0});
}

/// Equal multiples 1, 2, 5 and 10.
RecordingPointer family(bool isComplex)
{
    return made(isComplex, [](double t) {
        std::complex<double> sum = 0.0;
        for (const double multiple : {1.0, 2.0, 5.0, 10.0})
            sum += std::polar(1.0, 2.0 * std::numbers::pi * multiple * cyclesAt(t));
        return sum;
    });
}

double meanPower(const Recording &recording, Index first, Index length)
{
    std::vector<float> samples(static_cast<std::size_t>(length));
    recording.read(0, first, length, samples);
    double sum = 0.0;
    for (const float x : samples)
        sum += double(x) * double(x);
    return sum / double(length);
}

double decibels(double ratio)
{
    return 10.0 * std::log10(ratio);
}

} // namespace

/// A fundamental that swings, and its multiples, kept at one frequency each.
class tst_ResampledRecording : public QObject
{
    Q_OBJECT

private slots:
    void makesAllMultiplesConstant_data()
    {
        QTest::addColumn<bool>("isComplex");
        QTest::newRow("real") << false;
        QTest::newRow("I/Q") << true;
    }

    /// Nearly 30 s in one transform, bins of 0.034 Hz: each multiple has its amplitude in its own bin, to 0.1 dB.
    void makesAllMultiplesConstant()
    {
        QFETCH(bool, isComplex);
        constexpr double target = 64.0;
        const RecordingPointer base = family(isComplex);
        const ResampledRecording straight(base, 0, curve(), target);
        constexpr Index first = 1000, length = 58000;
        QVERIFY(straight.info().sampleCount > first + length);
        for (const double multiple : {1.0, 2.0, 5.0, 10.0}) {
            const double amplitude = amplitudeAt(straight, multiple * target, first, length);
            QVERIFY2(std::abs(2.0 * decibels(amplitude)) < 0.1, qPrintable(QString::number(amplitude)));
            QVERIFY(amplitudeAt(*base, multiple * target, first, length) < 0.4);
        }
    }

    void keepsLevels_data()
    {
        QTest::addColumn<double>("hz");
        for (const double hz : {1.0, 50.0, 300.0, 700.0, 860.0})
            QTest::newRow(qPrintable(QString::number(hz))) << hz;
    }

    /// A constant tone is no longer constant, but as strong as it was, up to 0.88 of half the rate. Time is stretched by
    /// less than 1.02 here.
    void keepsLevels()
    {
        QFETCH(double, hz);
        const RecordingPointer tone =
            made(false, [hz](double t) { return std::polar(1.0, 2.0 * std::numbers::pi * hz * t); });
        const FrequencyCurve swing({"time", "s", 0.0, 10.0, 4, false}, {49.5, 50.5, 49.5, 50.5});
        const double power = meanPower(ResampledRecording(tone, 0, swing, 50.0), 2000, 56000);
        QVERIFY2(std::abs(decibels(power / 0.5)) < 0.1, qPrintable(QString::number(decibels(power / 0.5))));
    }

    /// Where time runs twice as fast, what lay above half of half the rate has no place, and is not folded to another.
    void foldsNothingBack()
    {
        const FrequencyCurve constant({"time", "s", 0.0, 30.0, 2, false}, {50.0, 50.0});
        for (const double hz : {510.0, 600.0, 900.0}) {
            const RecordingPointer tone =
                made(false, [hz](double t) { return std::polar(1.0, 2.0 * std::numbers::pi * hz * t); });
            const double power = meanPower(ResampledRecording(tone, 0, constant, 100.0), 1000, 28000);
            QVERIFY2(decibels(power / 0.5) < -80.0,
                     qPrintable(QStringLiteral("%1 Hz: %2 dB").arg(hz).arg(decibels(power / 0.5))));
        }
        const RecordingPointer tone =
            made(false, [](double t) { return std::polar(1.0, 2.0 * std::numbers::pi * 200.0 * t); });
        QVERIFY(std::abs(amplitudeAt(ResampledRecording(tone, 0, constant, 100.0), 400.0, 1000, 28000) - 1.0) < 0.01);
    }

    /// A curve of 50 Hz taken to 100 halves times; an impulse is where it should be.
    void keepsTimes()
    {
        const RecordingPointer step = made(false, [](double t) { return t < 12.0 ? 0.0 : 1.0; });
        const ResampledRecording straight(step, 0, curve(), 64.0);
        const double expected = straight.secondsOf(12.0);
        QVERIFY(std::abs(expected - cyclesAt(12.0) / 64.0) < 1e-3);
        std::vector<float> samples(static_cast<std::size_t>(straight.info().sampleCount));
        straight.read(0, 0, straight.info().sampleCount, samples);
        const auto at =
            std::find_if(samples.begin(), samples.end(), [](float x) { return x > 0.5f; }) - samples.begin();
        QVERIFY(std::abs(double(at) / resampledRate - expected) < 2.0 / resampledRate);
        QCOMPARE(straight.info().sampleCount, Index(std::floor(straight.secondsOf(30.0) * resampledRate)));
    }

    void doesNotDependOnHowItIsRead()
    {
        const ResampledRecording straight(family(true), 0, curve(), 64.0);
        std::vector<float> whole(2 * 20000);
        straight.read(0, -100, 20000, whole);
        std::vector<float> part(2 * 333);
        straight.read(0, 7001, 333, part);
        for (std::size_t n = 0; n < part.size(); ++n)
            QCOMPARE(part[n], whole[2 * 7101 + n]);
    }

    void refusesWhatCannotBeStretched()
    {
        const FrequencyCurve across({"time", "s", 0.0, 30.0, 2, false}, {-5.0, 5.0});
        QVERIFY(test::contains(test::errorOf([&] { ResampledRecording(family(true), 0, across, 5.0); }),
                               "needs a fundamental above 0 Hz"));
        for (const double target : {0.0, -64.0, 2.0, 900.0})
            QVERIFY(test::contains(test::errorOf([&] { ResampledRecording(family(false), 0, curve(), target); }),
                                   "by a factor of 8 at most"));
        QVERIFY_EXCEPTION_THROWN(ResampledRecording(family(false), 1, curve(), 64.0), Error);
    }
};

FAINTLINE_TEST(tst_ResampledRecording)
#include "tst_ResampledRecording.moc"
