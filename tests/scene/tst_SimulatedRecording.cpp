#include "scene/SimulatedRecording.h"
#include "support/test.h"

#include "base/logmath.h"
#include "scene/InjectedRecording.h"
#include "scene/ornsteinUhlenbeck.h"
#include "support/recordings.h"

#include <thread>

using namespace faintline;
using namespace faintline::test;

namespace {

LineScene scene(bool isComplex, double rate = 8000.0, double duration = 20.0)
{
    return {.sampleRateHz = rate, .durationSeconds = duration, .isComplex = isComplex};
}

/// Everything at once.
LineScene busyScene(bool isComplex, double slope)
{
    LineScene result = scene(isComplex);
    result.noise = {0.2, slope, 2.0, 3.0};
    LineSettings wandering{.startSeconds = 2.3, .durationSeconds = 12.1, .wanderHz = 12.0};
    LineSettings fading{.driftHzPerSecond = 20.0, .fading = Fading::Rayleigh, .fadingSeconds = 0.7};
    LineSettings fluctuating{.startSeconds = 1.1, .fluctuation = Fluctuation::Swerling2};
    result.lines = {wandering, fading, fluctuating, LineSettings{}};
    return result;
}

/// Power spectral density over that of white noise of variance 1, at frequencies in cycles per sample.
double density(const std::vector<float> &samples, bool isComplex, double turns)
{
    constexpr Index window = 4096;
    const Index count = std::ssize(samples) / (isComplex ? 2 : 1) / window;
    std::vector<float> tapered(std::size_t(window) * (isComplex ? 2 : 1));
    double sum = 0.0;
    for (Index w = 0; w < count; ++w) {
        const float *from = samples.data() + w * std::ssize(tapered);
        for (std::size_t i = 0; i < tapered.size(); ++i) {
            const double phase = (double(i / (isComplex ? 2u : 1u)) + 0.5) / window;
            tapered[i] = from[i] * float(std::pow(std::sin(std::numbers::pi * phase), 2) / std::sqrt(0.375));
        }
        for (int k = -2; k <= 2; ++k)
            sum += std::norm(fourier(tapered.data(), window, isComplex, turns + k * 2.0 / window)) / window / 5.0;
    }
    return sum / double(count);
}

/// Powers of a complex line of frequency 0 over its mean power, sample by sample.
std::vector<double> relativePowers(Fluctuation fluctuation, double duration, int seed = 1)
{
    LineScene made = scene(true, 100.0, duration);
    made.noise.deviation = 1e-9;
    made.seed = seed;
    made.lines = {LineSettings{
        .snrDb = 120.0, .referenceSeconds = 0.5, .startSeconds = 1.25, .frequencyHz = 0.0, .fluctuation = fluctuation}};
    const SimulatedRecording recording(made);
    const std::vector<float> samples = readAll(recording);
    const double amplitude = recording.truth().lines.at(0).amplitude;
    std::vector<double> powers;
    for (std::size_t i = 125; 2 * i < samples.size(); ++i)
        powers.push_back((std::pow(double(samples[2 * i]), 2) + std::pow(double(samples[2 * i + 1]), 2))
                         / (amplitude * amplitude));
    return powers;
}

} // namespace

/// Simulated recordings: the same bytes however they are read, and SNR, wander, fading and noise as defined.
class tst_SimulatedRecording : public QObject
{
    Q_OBJECT

private slots:
    void randomAccessEqualsSequential_data()
    {
        QTest::addColumn<bool>("isComplex");
        QTest::addColumn<double>("slope");
        QTest::newRow("real, white") << false << 0.0;
        QTest::newRow("real, coloured") << false << -4.0;
        QTest::newRow("complex, white") << true << 0.0;
        QTest::newRow("complex, coloured") << true << 3.0;
    }

    void randomAccessEqualsSequential()
    {
        QFETCH(bool, isComplex);
        QFETCH(double, slope);
        const SimulatedRecording recording(busyScene(isComplex, slope));
        const std::vector<float> whole = readAll(recording);
        QCOMPARE(std::ssize(whole), Index(160000) * (isComplex ? 2 : 1));
        QVERIFY(readInPieces(recording, 777) == whole);
        QVERIFY(readInPieces(SimulatedRecording(busyScene(isComplex, slope)), 30000) == whole);
        QCOMPARE(recording.nonFiniteCount(), Index(0));
    }

    void threadsReadTheSame()
    {
        const SimulatedRecording recording(busyScene(true, -3.0));
        const std::vector<float> whole = readAll(recording);
        std::vector<float> first;
        std::vector<float> second;
        {
            const std::jthread one([&] { first = readInPieces(recording, 1000, 0, 1); });
            const std::jthread two([&] { second = readInPieces(recording, 5000, 0, 2); });
        }
        QVERIFY(first == whole);
        QVERIFY(second == whole);
    }

    void seedsDiffer()
    {
        LineScene other = busyScene(false, 0.0);
        const std::vector<float> one = readAll(SimulatedRecording(other));
        other.seed = 2;
        const std::vector<float> two = readAll(SimulatedRecording(other));
        double product = 0.0;
        for (std::size_t i = 0; i < one.size(); ++i)
            product += double(one[i]) * double(two[i]);
        QVERIFY(std::abs(product / double(one.size())) < 1e-3);
    }

    void noiseHasItsDeviation_data()
    {
        QTest::addColumn<bool>("isComplex");
        QTest::addColumn<double>("slope");
        for (const double slope : {-6.0, -3.0, 0.0, 3.0, 6.0}) {
            QTest::addRow("real %g", slope) << false << slope;
            QTest::addRow("complex %g", slope) << true << slope;
        }
    }

    void noiseHasItsDeviation()
    {
        QFETCH(bool, isComplex);
        QFETCH(double, slope);
        LineScene noise = scene(isComplex, 8000.0, 400.0);
        noise.noise.slopeDbPerOctave = slope;
        const std::vector<float> samples = readAll(SimulatedRecording(noise));
        double sum = 0.0;
        double squares = 0.0;
        for (const float value : samples) {
            sum += value;
            squares += double(value) * double(value);
        }
        const double count = 8000.0 * 400.0;
        QVERIFY(std::abs(sum / count) < 5.0 * 0.1 * std::sqrt(2000.0 / count));
        QVERIFY(std::abs(std::sqrt(squares / count) / 0.1 - 1.0) < (slope == 0.0 ? 0.003 : 0.03));
    }

    void snrIsAsDefined_data()
    {
        QTest::addColumn<bool>("isComplex");
        QTest::addColumn<double>("centreHz");
        QTest::addColumn<double>("frequencyHz");
        QTest::addColumn<double>("slope");
        QTest::addColumn<bool>("fades");
        QTest::newRow("real") << false << 0.0 << 1003.7 << 0.0 << false;
        QTest::newRow("complex") << true << 0.0 << 1003.7 << 0.0 << false;
        QTest::newRow("complex, below the centre") << true << 5e6 << 5e6 - 2503.3 << 0.0 << false;
        QTest::newRow("real, coloured") << false << 0.0 << 2003.7 << -3.0 << false;
        QTest::newRow("complex, coloured") << true << 0.0 << -303.7 << 4.0 << false;
        QTest::newRow("real, fading") << false << 0.0 << 1003.7 << 0.0 << true;
        QTest::newRow("complex, fading") << true << 0.0 << 1003.7 << 0.0 << true;
    }

    void snrIsAsDefined()
    {
        QFETCH(bool, isComplex);
        QFETCH(double, centreHz);
        QFETCH(double, frequencyHz);
        QFETCH(double, slope);
        QFETCH(bool, fades);
        constexpr Index window = 1000; // referenceSeconds of 0.125 s
        LineScene both = scene(isComplex, 8000.0, 125.0);
        both.centreHz = centreHz;
        both.noise.slopeDbPerOctave = slope;
        LineScene onlyNoise = both;
        LineSettings line{.snrDb = 7.0,
                          .referenceSeconds = 0.125,
                          .frequencyHz = frequencyHz,
                          .fading = fades ? Fading::Rayleigh : Fading::None,
                          .fadingSeconds = 1.0};
        both.lines = {line};

        // The seed being the same, the line is the difference.
        std::vector<float> tone = readAll(SimulatedRecording(both));
        const std::vector<float> noise = readAll(SimulatedRecording(onlyNoise));
        for (std::size_t i = 0; i < tone.size(); ++i)
            tone[i] -= noise[i];
        const Index floats = isComplex ? 2 : 1;
        const double turns = (frequencyHz - centreHz) / 8000.0;
        double tonePower = 0.0;
        double noisePower = 0.0;
        for (Index w = 0; w < 1000; ++w) {
            tonePower += std::norm(fourier(tone.data() + w * window * floats, window, isComplex, turns));
            for (int cell = 2; cell < 10; ++cell) // 16 cells beside the line's own: a standard error of 0.034 dB in all
                for (const double offset : {-1.0 * cell, 1.0 * cell})
                    noisePower += std::norm(fourier(noise.data() + w * window * floats, window, isComplex,
                                                    turns + offset / window))
                                  / 16.0;
        }
        const double measuredDb = dbFromRatio(tonePower / noisePower);
        QVERIFY2(std::abs(measuredDb - 7.0) < (fades ? 1.0 : 0.15), qPrintable(QString::number(measuredDb)));
    }

    void ornsteinUhlenbeckCorrelation()
    {
        Random random(1, 2);
        constexpr double step = 0.1;
        const std::vector<double> path = ornsteinUhlenbeck(random, 1'000'000, step);
        for (const std::size_t lag : {0u, 1u, 5u, 10u, 20u, 40u}) {
            double sum = 0.0;
            for (std::size_t i = lag; i < path.size(); ++i)
                sum += path[i] * path[i - lag];
            const double correlation = sum / double(path.size() - lag);
            QVERIFY(std::abs(correlation - std::exp(-step * double(lag))) < 5.0 * std::sqrt(2.0 / (step * 1e6)));
        }
    }

    void wanderHasItsDeviationExactly()
    {
        for (const int seed : {1, 2, 3}) {
            LineScene wandering = scene(false, 8000.0, 100.0);
            wandering.seed = seed;
            LineSettings line{.startSeconds = 10.0, .durationSeconds = 50.0, .wanderHz = 12.0};
            wandering.lines = {line};
            const TruthLine truth = SimulatedRecording(wandering).truth().lines.at(0);
            QCOMPARE(truth.startSeconds, 10.0);
            QCOMPARE(truth.endSeconds, 60.0);
            QCOMPARE(truth.frequencyHz.size(), std::size_t(2001)); // 0.1 · 0.25 s apart
            QVERIFY(std::abs(truth.stepSeconds - 0.025) < 1e-12);
            double sum = 0.0;
            double squares = 0.0;
            for (const double f : truth.frequencyHz) {
                sum += f - 1000.0;
                squares += (f - 1000.0) * (f - 1000.0);
            }
            QVERIFY(std::abs(sum / 2001.0) < 1e-9);
            QVERIFY(std::abs(std::sqrt(squares / 2001.0) - 12.0) < 1e-9);
        }
    }

    void truthIsTheFrequencyMeasured_data()
    {
        QTest::addColumn<bool>("isComplex");
        QTest::addColumn<double>("centreHz");
        QTest::newRow("real") << false << 0.0;
        QTest::newRow("complex") << true << 1e6;
    }

    void truthIsTheFrequencyMeasured()
    {
        QFETCH(bool, isComplex);
        QFETCH(double, centreHz);
        LineScene loud = scene(isComplex, 8000.0, 30.0);
        loud.centreHz = centreHz;
        LineSettings line{.snrDb = 80.0,
                          .startSeconds = 1.0,
                          .durationSeconds = 25.0,
                          .frequencyHz = centreHz + 1000.0,
                          .driftHzPerSecond = 7.0,
                          .wanderHz = 12.0};
        loud.lines = {line};
        const SimulatedRecording recording(loud);
        const TruthLine truth = recording.truth().lines.at(0);
        const std::vector<float> samples = readAll(recording);
        // The phase advance from one short window to the next is the frequency between them. For real samples the windows
        // must hold many periods, so that the mirror image at the negative frequency does not matter.
        const Index window = isComplex ? 20 : 80;
        double worst = 0.0;
        for (Index at = 8100; at < 8000 * 26 - 200; at += 997) {
            const Index floats = isComplex ? 2 : 1;
            const double between = (double(at + window) - 0.5) / 8000.0;
            const double expected = (truth.frequencyAt(between) - centreHz) / 8000.0;
            const std::complex<double> before = fourier(samples.data() + at * floats, window, isComplex, expected);
            const std::complex<double> after =
                fourier(samples.data() + (at + window) * floats, window, isComplex, expected);
            const double advance = std::arg(after / before) / (2.0 * std::numbers::pi); // in turns, but for whole ones
            const double error = advance - expected * double(window);
            worst = std::max(worst, std::abs(error - std::round(error)) / double(window) * 8000.0);
        }
        QVERIFY2(worst < (isComplex ? 0.5 : 3.0), qPrintable(QString::number(worst)));
    }

    void phaseIsContinuous()
    {
        LineScene loud = scene(true, 8000.0, 30.0);
        loud.noise.deviation = 1e-9;
        LineSettings line{.snrDb = 120.0, .wanderHz = 100.0, .wanderSeconds = 1.0};
        loud.lines = {line};
        const std::vector<float> samples = readAll(SimulatedRecording(loud));
        for (std::size_t i = 1; i + 1 < samples.size() / 2; ++i) {
            const auto at = [&](std::size_t k) { return std::complex<double>(samples[2 * k], samples[2 * k + 1]); };
            const double bend =
                std::arg(at(i + 1) * at(i - 1) / (at(i) * at(i))); // change of frequency, in radian per sample
            QVERIFY(std::abs(bend) < 1e-3);
        }
    }

    void toneBeginsAndEndsWhereItShould()
    {
        LineScene quiet = scene(false, 1000.0, 10.0);
        quiet.noise.deviation = 1e-9;
        LineSettings line{
            .snrDb = 60.0, .referenceSeconds = 1.0, .startSeconds = 2.0, .durationSeconds = 3.0, .frequencyHz = 123.0};
        quiet.lines = {line};
        const SimulatedRecording recording(quiet);
        const std::vector<float> samples = readAll(recording);
        const double amplitude = recording.truth().lines.at(0).amplitude;
        QVERIFY(std::abs(amplitude / (2.0 * 1e-9 * std::sqrt(1e6 / 1000.0)) - 1.0) < 1e-12); // 2σ√(r/T)
        const auto power = [&](std::size_t from, std::size_t to) {
            double sum = 0.0;
            for (std::size_t i = from; i < to; ++i)
                sum += std::pow(samples[i] / amplitude, 2);
            return sum;
        };
        QVERIFY(power(0, 2000) < 1.0);
        QVERIFY(std::abs(power(2000, 5000) - 1500.0) < 20.0);
        QVERIFY(power(2000, 2005) > 1.0 && power(4995, 5000) > 1.0);
        QVERIFY(power(5000, 10000) < 2.0);
    }

    void rayleighFading()
    {
        LineScene fading = scene(true, 100.0, 20000.0);
        fading.noise.deviation = 1e-9;
        LineSettings line{.snrDb = 120.0,
                          .referenceSeconds = 1.0,
                          .frequencyHz = 0.0,
                          .fading = Fading::Rayleigh,
                          .fadingSeconds = 2.0};
        fading.lines = {line};
        const SimulatedRecording recording(fading);
        const std::vector<float> samples = readAll(recording);
        const double amplitude = recording.truth().lines.at(0).amplitude;
        double power = 0.0;
        double squaredPower = 0.0;
        std::complex<double> lagged = 0.0;
        const std::size_t count = samples.size() / 2;
        constexpr std::size_t lag = 200; // one correlation time
        const auto at = [&](std::size_t i) {
            return std::complex<double>(samples[2 * i], samples[2 * i + 1]) / amplitude;
        };
        for (std::size_t i = 0; i < count; ++i) {
            power += std::norm(at(i)) / double(count);
            squaredPower += std::pow(std::norm(at(i)), 2) / double(count);
            if (i >= lag)
                lagged += at(i) * std::conj(at(i - lag)) / double(count - lag);
        }
        QVERIFY(std::abs(power - 1.0) < 0.06);                       // ten thousand independent stretches
        QVERIFY(std::abs(squaredPower / power / power - 2.0) < 0.2); // exponential law of the power
        QVERIFY(std::abs(lagged - std::exp(-1.0)) < 0.06);
    }

    void fluctuatesFromWindowToWindow()
    {
        for (const Fluctuation fluctuation : {Fluctuation::Swerling2, Fluctuation::Swerling4}) {
            const std::vector<double> powers = relativePowers(fluctuation, 5000.0);
            constexpr std::size_t window = 50; // samples of referenceSeconds
            const std::size_t windows = powers.size() / window;
            double mean = 0.0;
            double square = 0.0;
            double product = 0.0;
            for (std::size_t i = 0; i < windows; ++i) {
                const double first = powers[i * window];
                for (std::size_t k = 1; k < window; ++k)
                    QVERIFY(std::abs(powers[i * window + k] - first) < 1e-4 * first + 1e-4);
                mean += first / double(windows);
                square += first * first / double(windows);
                product += i == 0 ? 0.0 : first * powers[(i - 1) * window] / double(windows);
            }
            const double variance = fluctuation == Fluctuation::Swerling2 ? 1.0 : 0.5;
            const double error = 4.5 / std::sqrt(double(windows)); // 10 000 windows
            QVERIFY2(std::abs(mean - 1.0) < error * std::sqrt(variance), qPrintable(QString::number(mean)));
            QVERIFY2(std::abs(square - mean * mean - variance) < 3.0 * error, qPrintable(QString::number(square)));
            QVERIFY2(std::abs(product - 1.0) < 2.0 * error, qPrintable(QString::number(product))); // independent
        }
    }

    void fluctuatesFromLineToLine()
    {
        for (const Fluctuation fluctuation : {Fluctuation::Swerling1, Fluctuation::Swerling3}) {
            constexpr int lines = 400;
            double mean = 0.0;
            double square = 0.0;
            for (int seed = 0; seed < lines; ++seed) {
                const std::vector<double> powers = relativePowers(fluctuation, 4.0, seed);
                for (const double power : powers)
                    QVERIFY(std::abs(power - powers.front()) < 1e-4 * powers.front() + 1e-4);
                mean += powers.front() / lines;
                square += powers.front() * powers.front() / lines;
            }
            const double variance = fluctuation == Fluctuation::Swerling1 ? 1.0 : 0.5;
            const double error = 4.5 / std::sqrt(double(lines));
            QVERIFY2(std::abs(mean - 1.0) < error * std::sqrt(variance), qPrintable(QString::number(mean)));
            QVERIFY2(std::abs(square - mean * mean - variance) < 3.0 * error, qPrintable(QString::number(square)));
        }
    }

    void slopeOfTheNoise_data()
    {
        QTest::addColumn<bool>("isComplex");
        QTest::addColumn<double>("slope");
        QTest::newRow("real -6") << false << -6.0;
        QTest::newRow("real -3") << false << -3.0;
        QTest::newRow("real +2") << false << 2.0;
        QTest::newRow("real +6") << false << 6.0;
        QTest::newRow("complex -4") << true << -4.0;
    }

    void slopeOfTheNoise()
    {
        QFETCH(bool, isComplex);
        QFETCH(double, slope);
        LineScene coloured = scene(isComplex, 8000.0, 200.0);
        coloured.noise.slopeDbPerOctave = slope;
        const std::vector<float> samples = readAll(SimulatedRecording(coloured));
        const NoiseSource source(coloured.noise, 8000.0, 200.0, isComplex, 1);
        std::vector<double> levels;
        for (double hz = 60.0; hz < 1000.0; hz *= 2.0) {
            const double measured = density(samples, isComplex, hz / 8000.0);
            levels.push_back(dbFromRatio(measured));
            QVERIFY2(std::abs(dbFromRatio(measured / source.localVariance(hz))) < 0.6, // about 2000 degrees of freedom
                     qPrintable(QString::number(dbFromRatio(measured / source.localVariance(hz)))));
            if (isComplex) // the same on either side of the centre
                QVERIFY(std::abs(dbFromRatio(density(samples, true, -hz / 8000.0) / measured)) < 0.8);
        }
        const double octaves = double(levels.size() - 1);
        QVERIFY2(std::abs((levels.back() - levels.front()) / octaves - slope) < 0.2,
                 qPrintable(QString::number(levels.back() - levels.front())));
    }

    void levelDrift()
    {
        LineScene drifting = scene(false, 1000.0, 2000.0);
        drifting.noise.levelDriftDb = 3.0;
        drifting.noise.levelDriftSeconds = 20.0;
        const std::vector<float> samples = readAll(SimulatedRecording(drifting));
        std::vector<double> levels;
        for (std::size_t i = 0; i + 1000 <= samples.size(); i += 1000) {
            double sum = 0.0;
            for (std::size_t k = i; k < i + 1000; ++k)
                sum += double(samples[k]) * double(samples[k]) / 1000.0;
            levels.push_back(dbFromRatio(sum / 0.01));
        }
        double mean = 0.0;
        for (const double level : levels)
            mean += level / double(levels.size());
        double variance = 0.0;
        double lagged = 0.0;
        for (std::size_t i = 0; i < levels.size(); ++i) {
            variance += std::pow(levels[i] - mean, 2) / double(levels.size());
            lagged += i < 20 ? 0.0 : (levels[i] - mean) * (levels[i - 20] - mean) / double(levels.size() - 20);
        }
        QVERIFY(std::abs(mean) < 0.1);
        QVERIFY(std::abs(std::sqrt(variance) - 3.0) < 0.1);
        QVERIFY(std::abs(lagged / variance - std::exp(-1.0)) < 0.2);
    }

    void hoursInConstantMemory()
    {
        LineScene week = scene(false, 192000.0, 7.0 * 86400.0);
        LineSettings line{.startSeconds = 6.9 * 86400.0, .driftHzPerSecond = 0.01};
        week.lines = {line};
        const SimulatedRecording recording(week);
        QCOMPARE(recording.info().sampleCount, Index(116121600000));
        std::vector<float> end(1000);
        recording.read(0, recording.info().sampleCount - 1000, 1000, end);
        std::vector<float> part(10);
        recording.read(0, recording.info().sampleCount - 500, 10, part);
        QVERIFY(std::equal(part.begin(), part.end(), end.begin() + 500));
        QVERIFY(std::any_of(end.begin(), end.end(), [](float x) { return x != 0.0f; }));
    }

    void injectedLinesAddUp()
    {
        const LineScene quiet = scene(true, 8000.0, 20.0);
        const auto base = std::make_shared<SimulatedRecording>(quiet);
        LineSettings line{.snrDb = 3.0, .wanderHz = 5.0};
        LineScene withLine = quiet;
        withLine.lines = {line};
        const SimulatedRecording expected(withLine);
        const double amplitude = toneAmplitude(3.0, 0.1 * 0.1, 0.25 * 8000.0, true);
        const InjectedRecording injected(base, {{line, amplitude}}, 0, 1);
        QVERIFY(readAll(injected) == readAll(expected));
        QVERIFY(readInPieces(injected, 999) == readAll(expected));
        QVERIFY(injected.truth() == expected.truth());
        QCOMPARE(injected.info().sampleCount, base->info().sampleCount);
        QVERIFY(contains(injected.info().notes.back(), "1 known line(s)"));
        QVERIFY(readAll(InjectedRecording(base, {{line, amplitude}}, 1, 1)) == readAll(*base)); // another channel's
    }

    void injectedRefusals()
    {
        const auto base = std::make_shared<SimulatedRecording>(scene(false));
        LineSettings line;
        line.frequencyHz = 5000.0;
        QVERIFY(contains(errorOf([&] {
                             InjectedRecording(base, {{line, 1.0}}, 0, 1);
                         }),
                         "lines[0].frequencyHz = 5000: the line must stay"));
    }
};

FAINTLINE_TEST(tst_SimulatedRecording)
#include "tst_SimulatedRecording.moc"
