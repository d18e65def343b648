#include "evaluate/experiments/LineTrials.h"
#include "support/test.h"

#include "base/Random.h"

#include <cmath>
#include <numbers>

using namespace faintline;

namespace {

constexpr int samplesPerWindow = Experiment::windowSamples;

/// Two blocks in time, each as wide as the band, so that no line leaks into another's.
Experiment experiment()
{
    return {.seed = 3, .frames = 120, .blockFrames = 60, .blockBins = samplesPerWindow * 4, .durationSeconds = 20.0};
}

double powerAt(const std::vector<std::complex<float>> &field, Index frame, Index bin)
{
    return double(std::norm(field[std::size_t(frame * samplesPerWindow * 4 + bin)]));
}

} // namespace

/// Fields of an experiment's runs: transforms against the sum that defines them, lines where their truth says.
class tst_NoisyField : public QObject
{
    Q_OBJECT

private slots:
    void transformIsTheSumThatDefinesIt_data()
    {
        QTest::addColumn<int>("stepsPerWindow");
        QTest::addColumn<int>("binsPerCell");
        QTest::addColumn<int>("window");
        QTest::newRow("neither overlap nor padding") << 1 << 1 << int(WindowShape::Rectangular);
        QTest::newRow("half a window, twice as many bins") << 2 << 2 << int(WindowShape::Hann);
        QTest::newRow("a fifth of a window, three bins") << 5 << 3 << int(WindowShape::Rectangular);
    }

    // X(frame, bin) = Σ w(n) x(frame·hop + n) e^{-2πi(bin - half the bins)n/bins}, Σ w² = 1.
    void transformIsTheSumThatDefinesIt()
    {
        QFETCH(int, stepsPerWindow);
        QFETCH(int, binsPerCell);
        QFETCH(int, window);
        Experiment made{
            .frames = 3, .stepsPerWindow = stepsPerWindow, .binsPerCell = binsPerCell, .window = WindowShape(window)};
        const int hop = samplesPerWindow / stepsPerWindow;
        std::vector<float> samples(std::size_t(2 * (2 * hop + samplesPerWindow)));
        Random(5, 0).normals(samples, 1.0f);
        const std::vector<std::complex<float>> field = fieldTransform(made, samples);
        const int bins = samplesPerWindow * binsPerCell;
        QCOMPARE(field.size(), std::size_t(3 * bins));

        std::vector<double> weights;
        double squares = 0.0;
        for (int n = 0; n < samplesPerWindow; ++n) {
            const double turn = 2.0 * std::numbers::pi * (n + 0.5) / samplesPerWindow;
            weights.push_back(made.window == WindowShape::Hann ? 0.5 - 0.5 * std::cos(turn) : 1.0);
            squares += weights.back() * weights.back();
        }
        for (int frame = 0; frame < 3; ++frame)
            for (int bin = 0; bin < bins; bin += 7) {
                std::complex<double> sum = 0.0;
                for (int n = 0; n < samplesPerWindow; ++n) {
                    const auto at = std::size_t(2 * (frame * hop + n));
                    const std::complex<double> x(double(samples[at]), double(samples[at + 1]));
                    const double turns = double((bin - bins / 2) * n % bins) / bins;
                    sum += weights[std::size_t(n)] * x * std::polar(1.0, -2.0 * std::numbers::pi * turns);
                }
                const std::complex<double> found(field[std::size_t(frame * bins + bin)]);
                QVERIFY(std::abs(found - sum / std::sqrt(squares)) < 1e-4);
            }
    }

    void noiseHasUnitPowerInEveryBin()
    {
        Experiment made = experiment();
        made.frames = 1200;
        made.window = WindowShape::Hann;
        NoisyField field;
        makeNoise(made, 0, field);
        double sum = 0.0;
        for (const std::complex<float> value : field.noise)
            sum += double(std::norm(value));
        // 600 windows of 250 cells are independent at the least.
        QVERIFY(std::abs(sum / double(field.noise.size()) - 1.0) < 4.5 / std::sqrt(600.0 * 250.0));
        for (const Index bin : {0, 1, 499, 500, 501, 999}) {
            double ofBin = 0.0;
            for (Index frame = 0; frame < made.frames; ++frame)
                ofBin += powerAt(field.noise, frame, bin);
            QVERIFY(std::abs(ofBin / made.frames - 1.0) < 4.5 / std::sqrt(600.0));
        }
    }

    void runsHaveNoiseOfTheirOwn()
    {
        Experiment made = experiment();
        const NoisyField first = makeField(made, 4);
        NoisyField alone;
        makeNoise(made, 4, alone);
        QVERIFY(alone.noise == first.noise); // the lines take none of its numbers
        QVERIFY(makeField(made, 4).signal == first.signal);
        makeNoise(made, 5, alone);
        QVERIFY(alone.noise != first.noise);
        QVERIFY(makeField(made, 5).places[0].bins != first.places[0].bins);
        made.seed = 4;
        makeNoise(made, 4, alone);
        QVERIFY(alone.noise != first.noise);
    }

    void linesLieInTheirBlocks()
    {
        Experiment made = experiment();
        made.blockBins = 200;
        made.wanderHz = 2.0;
        QCOMPARE(made.signalsPerRun(), 10);
        for (int run = 0; run < 10; ++run) {
            const NoisyField field = makeField(made, run);
            QCOMPARE(field.places.size(), std::size_t(10));
            for (Index i = 0; i < 10; ++i) {
                const Place &place = field.places[std::size_t(i)];
                QCOMPARE(std::ssize(place.bins), Index(40));
                QVERIFY(place.firstFrame >= i / 5 * 60 && place.firstFrame + 40 <= (i / 5 + 1) * 60);
                for (const Index bin : place.bins)
                    QVERIFY(bin >= i % 5 * 200 && bin < (i % 5 + 1) * 200);
            }
        }
    }

    // Between bins, at most an eighth of a resolution cell away, a rectangular window sees sinc² of it.
    void aSteadyLineFillsItsBinWithItsPower()
    {
        const Experiment made = experiment();
        const double eighth = std::numbers::pi / 8.0;
        const double least = std::pow(std::sin(eighth) / eighth, 2.0);
        for (int run = 0; run < 5; ++run) {
            const NoisyField field = makeField(made, run);
            for (const Place &place : field.places) {
                const Index bin = place.bins.front();
                for (Index k = 0; k < 39; ++k) { // the last frame's window is half past it
                    QCOMPARE(place.bins[std::size_t(k)], bin);
                    const double power = powerAt(field.signal, place.firstFrame + k, bin);
                    QVERIFY2(power > least - 1e-3 && power < 1.001, qPrintable(QString::number(power)));
                }
                // A quarter of its power, half of its samples; two frames before there is none.
                const double half = powerAt(field.signal, place.firstFrame + 39, bin);
                QVERIFY(half > 0.25 * least - 1e-3 && half < 0.251);
                if (place.firstFrame % 60 >= 2)
                    QVERIFY(powerAt(field.signal, place.firstFrame - 2, bin) < 1e-9);
            }
        }
    }

    void aDriftingLineMovesAsItDrifts()
    {
        Experiment made = experiment();
        for (const double drift : {0.5, -0.5}) { // cells a window: one bin a frame
            made.driftHzPerSecond = drift;
            for (int run = 0; run < 5; ++run)
                for (const Place &place : makeField(made, run).places)
                    for (Index k = 0; k < 39; ++k) {
                        const double moved = double(place.bins[std::size_t(k)] - place.bins.front());
                        QVERIFY2(std::abs(moved - 2.0 * drift * double(k)) <= 1.0, qPrintable(QString::number(moved)));
                    }
        }
    }

    void powerAddsAmplitudes()
    {
        NoisyField field;
        std::vector<float> values(2 * 3 * 37 * 2);
        Random(6, 0).normals(values, 1.0f);
        for (std::size_t i = 0; i < values.size(); i += 4) {
            field.noise.emplace_back(values[i], values[i + 1]);
            field.signal.emplace_back(values[i + 2], values[i + 3]);
        }
        std::vector<float> y(37);
        for (const float amplitude : {0.0f, 0.25f, 3.0f}) {
            powerOf(field, 37, 2, amplitude, y);
            for (std::size_t i = 0; i < 37; ++i) {
                const std::complex<double> n(field.noise[2 * 37 + i]);
                const double expected =
                    std::norm(n + double(amplitude) * std::complex<double>(field.signal[2 * 37 + i]));
                QVERIFY(std::abs(double(y[i]) - expected) < 1e-5 * (1.0 + expected));
            }
        }
    }
};

FAINTLINE_TEST(tst_NoisyField)
#include "tst_NoisyField.moc"
