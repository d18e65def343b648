#include "evaluate/experiments/Experiment.h"
#include "support/test.h"

#include "base/Random.h"
#include "evaluate/experiments/LineTrials.h"
#include "evaluate/experiments/peers.h"
#include "support/errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace faintline;
using namespace faintline::test;

namespace {

Experiment experiment(std::vector<DetectorUnderTest> detectors)
{
    Experiment made;
    made.frames = 130; // ten frames beyond the second row of blocks
    made.blockFrames = 60;
    made.durationSeconds = 10.0;
    made.snrDb = {-6.0, 4.0};
    made.detectors = std::move(detectors);
    return made;
}

/// Power of each line in each of its frames, where it is strongest, over that of a constant line.
std::vector<std::vector<double>> relativePowers(Experiment made, Fluctuation fluctuation)
{
    const NoisyField constant = makeField(made, 1);
    made.fluctuation = fluctuation;
    const NoisyField field = makeField(made, 1);
    std::vector<std::vector<double>> powers;
    for (const Place &place : constant.places) {
        std::vector<double> &line = powers.emplace_back();
        for (std::size_t k = 0; k < place.bins.size(); ++k) {
            const auto at = std::size_t((place.firstFrame + Index(k)) * made.bins() + place.bins[k]);
            line.push_back(double(std::norm(field.signal[at]) / std::norm(constant.signal[at])));
        }
    }
    return powers;
}

Experiment separateFrames()
{
    Experiment made = experiment({peer("energy", 10.0)});
    made.stepsPerWindow = 1;
    return made;
}

Experiment fadingAndFluctuating(Experiment made)
{
    made.fading = Fading::Rayleigh;
    made.fluctuation = Fluctuation::Swerling1;
    return made;
}

constexpr int samplesPerWindow = Experiment::windowSamples;

/// Two blocks in time, each as wide as the band, so that no line leaks into another's.
Experiment twoBlocks()
{
    return {.seed = 3, .frames = 120, .blockFrames = 60, .blockBins = samplesPerWindow * 4, .durationSeconds = 20.0};
}

double powerAt(const std::vector<std::complex<float>> &field, Index frame, Index bin)
{
    return double(std::norm(field[std::size_t(frame * samplesPerWindow * 4 + bin)]));
}

} // namespace

/// An experiment's runs against plain loops over their fields, these against the sum that defines them and where their
/// truth says; and what cannot be an experiment.
class tst_LineTrials : public QObject
{
    Q_OBJECT

private slots:
    // One frame's energy is its own statistic: D is y.
    void outcomesAreTheLargestOfTheirCells()
    {
        const Experiment made = experiment({peer("energy", 10.0)});
        const std::vector<RunOutcome> outcomes = LineTrials(made).run({7, 2});
        QCOMPARE(outcomes.size(), std::size_t(2));
        for (const RunOutcome &outcome : outcomes) {
            const NoisyField field = makeField(made, outcome.run);
            std::vector<float> noise(10, 0.0f);
            for (std::size_t i = 0; i < 120 * 1000; ++i) {
                float &largest = noise[i / 1000 / 60 * 5 + i % 1000 / 200];
                largest = std::max(largest, std::norm(field.noise[i]));
            }
            for (std::size_t s = 0; s < 2; ++s)
                for (std::size_t i = 0; i < 10; ++i) {
                    const auto amplitude = float(std::pow(10.0, made.snrDb[s] / 20.0));
                    float largest = 0.0f;
                    for (std::size_t k = 0; k < 20; ++k) {
                        const auto at =
                            std::size_t((field.places[i].firstFrame + Index(k)) * 1000 + field.places[i].bins[k]);
                        largest = std::max(largest, std::norm(field.noise[at] + amplitude * field.signal[at]));
                    }
                    QVERIFY(std::abs(outcome.signal[0][s][i] - largest) < 1e-4f * (1.0f + largest));
                    QVERIFY(std::abs(outcome.noise[0][i] - noise[i]) < 1e-4f * (1.0f + noise[i]));
                }
        }
        QCOMPARE(outcomes[0].run, 7);
        QCOMPARE(outcomes[1].run, 2);
    }

    // A mean over one window of half a window's steps: two frames of the same bin.
    void everyOtherFrameAlone()
    {
        Experiment made = experiment({peer("integrator", 1.0)});
        made.snrDb = {0.0};
        const RunOutcome outcome = LineTrials(made).run({3}).front();
        const NoisyField field = makeField(made, 3);
        std::vector<float> expected(10, 0.0f);
        for (std::size_t frame = 1; frame < 120; ++frame)
            for (std::size_t bin = 0; bin < 1000; ++bin) {
                const float mean =
                    0.5f
                    * (std::norm(field.noise[frame * 1000 + bin]) + std::norm(field.noise[(frame - 1) * 1000 + bin]));
                float &largest = expected[frame / 60 * 5 + bin / 200];
                largest = std::max(largest, mean);
            }
        for (std::size_t i = 0; i < 10; ++i)
            QVERIFY2(std::abs(outcome.noise[0][i] - expected[i]) < 1e-4f * expected[i],
                     qPrintable(QString("%1, not %2").arg(double(outcome.noise[0][i])).arg(double(expected[i]))));
    }

    // Lines begin with a window, so each window has the line's power of a moment of its own.
    void linesFluctuateFromWindowToWindow()
    {
        double mean = 0.0;
        double square = 0.0;
        int windows = 0;
        for (const std::vector<double> &line : relativePowers(separateFrames(), Fluctuation::Swerling2))
            for (const double power : line) {
                mean += power;
                square += power * power;
                ++windows;
            }
        QCOMPARE(windows, 100);
        QVERIFY2(std::abs(mean / windows - 1.0) < 0.45, qPrintable(QString::number(mean / windows)));
        QVERIFY2(square / windows > 1.2, qPrintable(QString::number(square / windows))); // 2 is expected
    }

    void linesFluctuateAsAWhole()
    {
        std::vector<double> powers;
        for (const std::vector<double> &line : relativePowers(separateFrames(), Fluctuation::Swerling1)) {
            for (const double power : line)
                QVERIFY2(std::abs(power - line.front())
                             < 0.2 * std::sqrt(line.front()) + 0.02, // neighbours leak into it
                         qPrintable(QString("%1, not %2").arg(power).arg(line.front())));
            powers.push_back(line.front());
        }
        std::sort(powers.begin(), powers.end());
        QVERIFY(powers.back() > 2.0 * powers.front()); // ten lines have ten powers
    }

    void sinksSeeEveryRunOnce()
    {
        const Experiment made = experiment({peer("energy", 10.0)});
        RunContext context;
        context.threads = 3;
        std::vector<RunOutcome> seen;
        const auto outcomes =
            LineTrials(made).run({4, 0, 9, 1}, context, [&](const RunOutcome &outcome) { seen.push_back(outcome); });
        QCOMPARE(seen.size(), std::size_t(4));
        for (const RunOutcome &outcome : outcomes)
            QCOMPARE(std::count(seen.begin(), seen.end(), outcome), std::ptrdiff_t(1));
    }

    void noRunsNoOutcomes()
    {
        int seen = 0;
        QVERIFY(
            LineTrials(experiment({peer("energy", 10.0)})).run({}, {}, [&](const RunOutcome &) { ++seen; }).empty());
        QCOMPARE(seen, 0);
    }

    void resetsAreFoundForMarkovDetectorsAlone()
    {
        Experiment made = experiment({peer("SMD stable", 10.0), peer("energy", 10.0), peer("SMD 5 slopes", 10.0)});
        made.frames = 600;
        made.binsPerCell = 1;
        const std::vector<ResetRule> rules = LineTrials(made).resets();
        QCOMPARE(rules.size(), std::size_t(3));
        QCOMPARE(rules[1].lnK, 0.0);
        // Of three equal chances each step costs ln 3 nat, which K gives back where there is a choice of slopes.
        QVERIFY(rules[0].lnK < 0.0 && rules[2].lnK > 0.0);
        Experiment other = made;
        other.detectors = {peer("SMD stable", 10.0)};
        QCOMPARE(LineTrials(other).resets().front().lnK, rules[0].lnK); // whatever else is tried
        other.seed = 2;
        const double again = LineTrials(other).resets().front().lnK;
        QVERIFY(again != rules[0].lnK && std::abs(again - rules[0].lnK) < 0.05);
    }

    // K is of the detector on noise: how long an experiment's runs are does not matter to it.
    void resetsOfShortRunsAreThoseOfLongOnes()
    {
        Experiment made = experiment({peer("SMD stable", 10.0), peer("SMD 5 slopes", 10.0)});
        made.frames = 1000;
        made.binsPerCell = 1;
        const std::vector<ResetRule> expected = LineTrials(made).resets();
        for (const int frames : {60, 130, 300, 301}) {
            made.frames = frames;
            const std::vector<ResetRule> rules = LineTrials(made).resets();
            for (std::size_t i = 0; i < 2; ++i)
                QVERIFY2(
                    std::abs(rules[i].lnK - expected[i].lnK) < 0.1,
                    qPrintable(QString("%1 frames: %2, not %3").arg(frames).arg(rules[i].lnK).arg(expected[i].lnK)));
        }
    }

    void cancels()
    {
        std::stop_source source;
        RunContext context;
        context.stop = source.get_token();
        int seen = 0;
        const auto stopAtTheFirst = [&](const RunOutcome &) {
            ++seen;
            source.request_stop();
        };
        QVERIFY_THROWS_EXCEPTION(
            Cancelled, LineTrials(experiment({peer("energy", 10.0)})).run({0, 1, 2, 3}, context, stopAtTheFirst));
        QCOMPARE(seen, 1);
    }

    void countsOfBlocks()
    {
        Experiment made;
        QCOMPARE(made.bins(), 1000);
        QCOMPARE(made.blocksInTime(), 6); // 2000 of 300 frames, the rest is left over
        QCOMPARE(made.blocksInFrequency(), 5);
        QCOMPARE(made.signalsPerRun(), 30);
        QCOMPARE(made.signalFrames(), 200);
        made.durationSeconds = 0.75;
        QCOMPARE(made.signalFrames(), 2); // one and a half
        made.durationSeconds = 0.7;
        QCOMPARE(made.signalFrames(), 1);
    }

    void refusals_data()
    {
        QTest::addColumn<QString>("member");
        QTest::addColumn<QString>("words");
        QTest::newRow("detectors") << "detectors"
                                   << "detectors: must name at least one detector";
        QTest::newRow("snrDb") << "snrDb"
                               << "snrDb: must hold at least one value";
        QTest::newRow("stepsPerWindow") << "stepsPerWindow"
                                        << "stepsPerWindow = 3: must divide 250, the samples of a window";
        QTest::newRow("blockBins") << "blockBins"
                                   << "blockFrames, blockBins: a block must fit into the field of 130 × 1000 cells";
        QTest::newRow("blockFrames") << "blockFrames"
                                     << "blockFrames, blockBins: a block must fit into the field of 130 × 1000 cells";
        QTest::newRow("durationWindows") << "durationWindows"
                                         << "durationWindows = 30.5: a line must last 1 … blockFrames = 60 frames";
        QTest::newRow("fluctuation") << "fluctuation"
                                     << "fluctuation = swerling1: is not possible with fading; use one of the two";
        QTest::newRow("drift")
            << "drift"
            << "driftCellsPerWindow, wanderCells: a line must stay within its block of blockBins = 200 "
               "bins";
    }

    void refusals()
    {
        QFETCH(QString, member);
        QFETCH(QString, words);
        Experiment made = experiment({peer("energy", 10.0)});
        QCOMPARE(errorOf([&] { checkExperiment(made); }), std::string());
        if (member == "detectors")
            made.detectors.clear();
        else if (member == "snrDb")
            made.snrDb.clear();
        else if (member == "stepsPerWindow")
            made.stepsPerWindow = 3;
        else if (member == "blockBins")
            made.blockBins = 1001;
        else if (member == "blockFrames")
            made.blockFrames = 131;
        else if (member == "durationWindows")
            made.durationSeconds = 30.5;
        else if (member == "fluctuation")
            made = fadingAndFluctuating(made);
        else
            made.driftHzPerSecond = 4.7; // 47 cells in ten windows, where 46 have room
        QCOMPARE(QString::fromStdString(errorOf([&] { checkExperiment(made); })), words);
    }

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
        Experiment made = twoBlocks();
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
        Experiment made = twoBlocks();
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
        Experiment made = twoBlocks();
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
        const Experiment made = twoBlocks();
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
        Experiment made = twoBlocks();
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

FAINTLINE_TEST(tst_LineTrials)
#include "tst_LineTrials.moc"
