#include "base/Random.h"
#include "signal/ResidualRecording.h"
#include "support/test.h"

#include "support/recordings.h"

#include <cmath>
#include <complex>
#include <numbers>

using namespace faintline;

namespace {

constexpr double rate = 400.0;
constexpr double window = 0.25; // a cell is 4 Hz
constexpr Index count = 24000;
constexpr double pi = std::numbers::pi;

/// Frequency at t seconds is hz + drift·t, from and to given samples.
struct Line {
    double hz = 0.0;
    double amplitude = 1.0;
    double drift = 0.0;
    Index from = 0;
    Index to = count;

    double at(double t) const { return hz + drift * t; }
    std::complex<double> value(Index n) const
    {
        const double t = double(n) / rate;
        return n < from || n >= to ? 0.0 : std::polar(amplitude, 2.0 * pi * (hz * t + 0.5 * drift * t * t) + 0.7);
    }
};

std::shared_ptr<test::MemoryRecording> recordingOf(const std::vector<Line> &lines, bool isComplex, float noise = 0.0f)
{
    std::vector<float> samples(std::size_t(count * (isComplex ? 2 : 1)));
    if (noise > 0.0f)
        Random(11, 0).normals(samples, noise);
    for (Index n = 0; n < count; ++n)
        for (const Line &line : lines) {
            const std::complex<double> value = line.value(n);
            if (!isComplex) {
                samples[std::size_t(n)] += float(value.real());
                continue;
            }
            samples[std::size_t(2 * n)] += float(value.real());
            samples[std::size_t(2 * n + 1)] += float(value.imag());
        }
    return std::make_shared<test::MemoryRecording>(std::move(samples), rate, isComplex);
}

/// As a track would tell of a line, `offHz` off: a knot each half window, middles of windows that hold all of it.
LinePath pathOf(const Line &line, double offHz = 0.0)
{
    const double from = double(line.from) / rate;
    const double to = double(line.to) / rate;
    const Axis time{"time", "s", from, 0.5 * window, Index((to - from) / (0.5 * window)) + 1, false};
    std::vector<double> hz;
    for (Index i = 0; i < time.count; ++i)
        hz.push_back(line.at(time.value(double(i))) + offHz);
    return {{time, hz}, from + 0.5 * window, to - 0.5 * window, window};
}

ResidualRecording residual(const RecordingPointer &recording, const std::vector<LinePath> &paths)
{
    return {recording, 0, paths};
}

/// Mean power of samples from … to.
double power(const std::vector<float> &samples, bool isComplex, Index from = 0, Index to = count)
{
    const Index floats = isComplex ? 2 : 1;
    double sum = 0.0;
    for (Index i = from * floats; i < to * floats; ++i)
        sum += double(samples[std::size_t(i)]) * double(samples[std::size_t(i)]);
    return sum / double(to - from);
}

double db(double ratio)
{
    return 10.0 * std::log10(ratio);
}

/// Amplitude of a frequency in the middle of a recording, over a Hann window of 100 T.
double amplitudeAt(const std::vector<float> &samples, bool isComplex, double hz)
{
    const Index length = Index(100.0 * window * rate);
    const Index first = (count - length) / 2;
    std::complex<double> sum = 0.0;
    for (Index i = 0; i < length; ++i) {
        const auto n = std::size_t(first + i);
        const std::complex<double> x = isComplex ? std::complex<double>(samples[2 * n], samples[2 * n + 1])
                                                 : std::complex<double>(samples[n], 0.0);
        const double w = 1.0 - std::cos(2.0 * pi * (double(i) + 0.5) / double(length));
        sum += w * x * std::polar(1.0, -2.0 * pi * hz * double(first + i) / rate);
    }
    return std::abs(sum) / double(length) * (isComplex ? 1.0 : 2.0);
}

/// The share of an amplitude that a cubic spline with knots a cell⁻¹ apart takes of a tone, by its projection.
double takenShare(double cells)
{
    double all = 0.0;
    const auto power = [](double x) { return std::abs(x) < 1e-12 ? 1.0 : std::pow(std::sin(pi * x) / (pi * x), 8.0); };
    for (int k = -50; k <= 50; ++k)
        all += power(cells + double(k));
    return power(cells) / all;
}

} // namespace

/// What is left of a recording without a strong line, against what was put into it.
class tst_ResidualRecording : public QObject
{
    Q_OBJECT

private slots:
    void nothingIsLeftOfALine_data()
    {
        QTest::addColumn<bool>("isComplex");
        QTest::addColumn<double>("hz");
        QTest::addColumn<double>("drift");
        QTest::addColumn<double>("offHz");
        QTest::addColumn<double>("mostDb");
        QTest::newRow("real") << false << 91.3 << 0.0 << 0.0 << -100.0;
        QTest::newRow("I/Q") << true << -91.3 << 0.0 << 0.0 << -100.0;
        QTest::newRow("real, drifting") << false << 60.3 << 1.3 << 0.0 << -95.0;
        QTest::newRow("I/Q, drifting") << true << 60.3 << -1.3 << 0.0 << -95.0;
        QTest::newRow("real, known to 0.1 cells") << false << 91.3 << 0.0 << 0.4 << -70.0;
        QTest::newRow("I/Q, known to 0.1 cells") << true << 91.3 << 0.0 << -0.4 << -70.0;
        QTest::newRow("real, known to 0.2 cells") << false << 91.3 << 0.0 << 0.8 << -45.0;
        QTest::newRow("real, near 0 Hz") << false << 1.1 << 0.0 << 0.0 << -95.0;
        QTest::newRow("real, near half the rate") << false << 198.9 << 0.0 << 0.0 << -95.0;
    }

    void nothingIsLeftOfALine()
    {
        QFETCH(bool, isComplex);
        QFETCH(double, hz);
        QFETCH(double, drift);
        QFETCH(double, offHz);
        QFETCH(double, mostDb);
        const Line line{hz, 0.3, drift};
        const RecordingPointer recording = recordingOf({line}, isComplex);
        const double before = power(test::readAll(*recording), isComplex);
        const double after = power(test::readAll(residual(recording, {pathOf(line, offHz)})), isComplex);
        QVERIFY2(db(after / before) < mostDb, qPrintable(QString::number(db(after / before))));
    }

    void takesTheShareOfItsSplines_data()
    {
        QTest::addColumn<bool>("isComplex");
        QTest::addColumn<double>("cells");
        for (const double cells : {0.75, 1.0, 1.5, 2.0, 2.5}) {
            QTest::addRow("I/Q, %g cells away", cells) << true << cells;
            QTest::addRow("real, %g cells away", cells) << false << cells;
        }
    }

    /// Of a line 40 dB below it beside a strong one, in closed form: a tone's share, all of it but 0.2 dB.
    void takesTheShareOfItsSplines()
    {
        QFETCH(bool, isComplex);
        QFETCH(double, cells);
        const Line strong{91.3, 100.0};
        const Line beside{91.3 + cells / window};
        const auto samples = test::readAll(residual(recordingOf({strong, beside}, isComplex), {pathOf(strong)}));
        const double left = amplitudeAt(samples, isComplex, beside.hz);
        QVERIFY2(std::abs(left - (1.0 - takenShare(cells))) < 0.004, qPrintable(QString::number(left)));
        if (cells >= 0.75)
            QVERIFY2(std::abs(2.0 * db(left)) < 0.2, qPrintable(QString::number(2.0 * db(left))));
    }

    void aLineThatBeginsAndStops_data()
    {
        QTest::addColumn<bool>("isComplex");
        QTest::addColumn<double>(
            "early"); // windows that the track begins too late and ends too early, and the other way
        for (const bool isComplex : {false, true})
            for (const double early : {-0.5, 0.0, 0.5, 1.0})
                QTest::addRow("%s, %g windows inside", isComplex ? "I/Q" : "real", early) << isComplex << early;
    }

    /// In noise 40 dB below it in a cell, what is left near its ends is as strong as the noise.
    void aLineThatBeginsAndStops()
    {
        QFETCH(bool, isComplex);
        QFETCH(double, early);
        const double cellSamples = window * rate;
        const float noise = 0.1f;
        const double variance = double(noise) * double(noise) * (isComplex ? 2.0 : 1.0);
        const double amplitude = (isComplex ? 1.0 : 2.0) * std::sqrt(variance * 1e4 / cellSamples);
        const Line line{91.3, amplitude, 0.1, 8117, 15033};
        const RecordingPointer recording = recordingOf({line}, isComplex, noise);
        LinePath path = pathOf(line, 0.1);
        path.fromSeconds += early * window;
        path.toSeconds -= early * window;
        const ResidualRecording rest = residual(recording, {path});
        QCOMPARE(std::ssize(rest.lines()), Index(1));
        const auto samples = test::readAll(rest);
        for (const Index end : {line.from, line.to}) {
            const double left = power(samples, isComplex, end - 50, end + 50) / variance;
            QVERIFY2(left < 1.6, qPrintable(QString::number(left)));
        }
    }

    /// An end that is not abrupt: the amplitude falls over ten windows, and the track lasts as long. Of a
    /// line at 40 dB less is left than there is noise.
    void aLineThatFades()
    {
        std::vector<float> samples(std::size_t(count), 0.0f);
        for (Index n = 0; n < count; ++n) {
            const double envelope = std::clamp(double(14000 - n) / 1000.0, 0.0, 1.0);
            samples[std::size_t(n)] = float(envelope * std::cos(2.0 * pi * 91.3 * double(n) / rate));
        }
        const auto recording = std::make_shared<test::MemoryRecording>(samples, rate);
        const auto rest = test::readAll(residual(recording, {pathOf({91.3, 1.0, 0.0, 0, 14000})}));
        double most = 0.0;
        for (Index n = 0; n + 100 <= count; n += 50)
            most = std::max(most, power(rest, false, n, n + 100));
        QVERIFY2(db(most / 0.5) < -40.0, qPrintable(QString::number(db(most / 0.5))));
    }

    /// 1 + 3/T of T·rate real ones for each window, and twice as many of twice as many for I/Q.
    void takesOneUnknownAWindowFromNoise()
    {
        const RecordingPointer recording = recordingOf({}, true, 1.0f);
        const double before = power(test::readAll(*recording), true);
        const double after = power(test::readAll(residual(recording, {pathOf({91.3})})), true);
        const double windows = double(count) / (window * rate);
        const double unknowns = windows + 3.0;
        QVERIFY2(std::abs((before - after) / 2.0 * double(count) - unknowns) < 4.0 * std::sqrt(unknowns),
                 qPrintable(QString::number((before - after) / 2.0 * double(count))));
    }

    /// With noise of its own kind to put back, there is as much of it along the path as before.
    void leavesNoiseWhereItWas()
    {
        for (const bool isComplex : {false, true}) {
            const Line line{91.3, 10.0};
            const RecordingPointer recording = recordingOf({line}, isComplex, 1.0f);
            std::vector<float> simulated(std::size_t(count * (isComplex ? 2 : 1)));
            Random(12, 0).normals(simulated, 1.0f);
            const test::MemoryRecording noise(simulated, rate, isComplex);
            const auto samples = test::readAll(ResidualRecording(recording, 0, {pathOf(line)}, &noise));
            const double wanted = isComplex ? 2.0 : 1.0;
            const double all = power(samples, isComplex) / wanted;
            QVERIFY2(std::abs(all - 1.0) < 4.0 * std::sqrt(2.0 / wanted / double(count)),
                     qPrintable(QString::number(all)));
            double there = 0.0;
            constexpr Index length = 100; // a window
            for (Index first = 0; first < count; first += length)
                there += std::norm(test::fourier(samples.data() + first * (isComplex ? 2 : 1), length, isComplex,
                                                 line.hz / rate))
                         / double(length) / wanted;
            const double windows = double(count / length);
            QVERIFY2(std::abs(there / windows - 1.0) < 4.0 / std::sqrt(windows),
                     qPrintable(QString::number(there / windows)));
        }
    }

    /// A line of -30 dB, a cell and a half beside the other: both go.
    void twoLinesOneAfterTheOther()
    {
        const Line strong{91.3, 1.0};
        const Line weak{91.3 + 1.5 / window, 0.0316};
        const auto rest = test::readAll(residual(recordingOf({strong, weak}, false), {pathOf(strong), pathOf(weak)}));
        const double left = db(power(rest, false) / 0.5);
        QVERIFY2(left < -58.0, qPrintable(QString::number(left)));
    }

    void silenceStays()
    {
        const Line line{91.3, 0.5};
        std::vector<float> samples = test::readAll(*recordingOf({line}, false));
        std::fill(samples.begin() + 9600, samples.begin() + 12800, 0.0f);
        const auto rest =
            test::readAll(residual(std::make_shared<test::MemoryRecording>(samples, rate), {pathOf(line)}));
        QVERIFY(std::all_of(rest.begin() + 9600, rest.begin() + 12800, [](float value) { return value == 0.0f; }));
        QVERIFY(db(power(rest, false) / 0.125) < -60.0);
    }

    void doesNotDependOnHowItIsRead()
    {
        for (const bool isComplex : {false, true}) {
            const Line line{91.3, 1.0, 0.4, 5000, 17011};
            const ResidualRecording rest = residual(recordingOf({line}, isComplex, 0.1f), {pathOf(line)});
            QVERIFY(test::readAll(rest) == test::readInPieces(rest, 777));
            std::vector<float> outside(20, 1.0f);
            rest.read(0, -20, 20 / rest.info().floatsPerSample(), outside);
            QVERIFY(outside == std::vector<float>(20, 0.0f));
        }
    }

    void otherChannelsStay()
    {
        const Line line{91.3, 1.0};
        const auto recording = recordingOf({line}, false);
        recording->mutableInfo().channelCount = 2;
        const ResidualRecording rest(recording, 1, {pathOf(line)});
        QVERIFY(test::readAll(rest, 0) == test::readAll(*recording, 0));
        QVERIFY(test::readAll(rest, 1) != test::readAll(*recording, 1));
    }
};

FAINTLINE_TEST(tst_ResidualRecording)
#include "tst_ResidualRecording.moc"
