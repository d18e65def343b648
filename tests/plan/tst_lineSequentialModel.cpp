#include "evaluate/sequential/SequentialTrial.h"
#include "plan/lineSequentialModel.h"
#include "scene/SimulatedRecording.h"
#include "support/recordings.h"
#include "support/test.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <complex>
#include <numbers>
#include <numeric>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr int windowSamples = 64;

NormalisedFramesPointer frames(int stepsPerWindow, double windows)
{
    LineScene scene{.sampleRateHz = 1.0, .durationSeconds = windows * windowSamples, .isComplex = true};
    scene.noise.deviation = 1.0;
    SpectrogramSettings settings{.windowSeconds = windowSamples, .stepsPerWindow = stepsPerWindow};
    const auto spectrogram = std::make_shared<Spectrogram>(std::make_shared<SimulatedRecording>(scene), settings);
    return std::make_shared<NormalisedSpectrogram>(spectrogram, estimateBackground(*spectrogram, {}),
                                                   NormaliserSettings{});
}

Grid part(const NormalisedFrames &whole, Index first, Index count)
{
    Axis axis = whole.grid().axes[0];
    axis.first = axis.value(double(first));
    axis.count = count;
    axis.cyclic = false;
    return {{axis}};
}

constexpr Index band = 10;

/// White noise of variance 1 with a target in it that moves as the model says from one window to the next that does not
/// overlap it. Its amplitude is complex normal and anew in each: of SNR ρ behind the Hann window, which leaves ⅔ of a
/// rectangle's.
RecordingPointer targetInNoise(const SequentialModel &model, int windows, std::uint64_t stream)
{
    std::vector<float> samples(std::size_t(2 * windows * windowSamples));
    Random random(77, stream);
    random.normals(samples, float(std::sqrt(0.5)));
    const TrajectorySampler sampler(model);
    Index state = sampler.first(random);
    const double deviation = std::sqrt(0.5 * model.markov.likelihood.snr() * 1.5 / windowSamples);
    for (Index window = 0, stage = 0; window < windows; ++window) {
        const double turns = double(state % model.markov.space.cellCount()) / (2.0 * windowSamples);
        const std::complex<double> amplitude(deviation * random.normal(), deviation * random.normal());
        for (Index n = window * windowSamples; n < (window + 1) * windowSamples; ++n) {
            const std::complex<double> value = amplitude * std::polar(1.0, 2.0 * std::numbers::pi * turns * double(n));
            samples[std::size_t(2 * n)] += float(value.real());
            samples[std::size_t(2 * n + 1)] += float(value.imag());
        }
        for (Index i = 0; i < model.observedEvery; ++i)
            state = sampler.next(state, random, ++stage);
    }
    return std::make_shared<MemoryRecording>(std::move(samples), 1.0, true);
}

/// Tests one after the other along the frames of noise, each from where the one before stopped: those decided, those
/// that went wrong.
struct Counted {
    int tests = 0;
    int wrong = 0;
};
Counted along(const NormalisedFramesPointer &noise, Index observedEvery, const ModelSettings &settings)
{
    Counted counted;
    for (Index firstCell = 4; firstCell + band < noise->grid().size() - 4; firstCell += 2 * band) {
        SequentialModel model = lineSequentialModel(settings, part(*noise, firstCell, band), *noise);
        model.observedEvery = observedEvery;
        for (Index first = 0;;) {
            const Index left = noise->time().count - first;
            const SprtResult result = runSprt(model, {0.02, 0.02, 0}, left, stagesOf(noise, first, firstCell, band));
            if (result.decision == SprtDecision::Undecided)
                break;
            ++counted.tests;
            counted.wrong += result.decision == SprtDecision::H1 ? 1 : 0;
            first += result.stages + 8;
        }
    }
    return counted;
}

/// α = β = 0.02: four standard deviations of what is counted are allowed.
void verify(const Counted &counted)
{
    QVERIFY2(counted.tests >= 300, qPrintable(QString::number(counted.tests)));
    const double expected = 0.02 * counted.tests;
    QVERIFY2(counted.wrong < expected + 4.0 * std::sqrt(expected),
             qPrintable(QString("%1 of %2").arg(counted.wrong).arg(counted.tests)));
}

ModelSettings exponential(ModelSettings settings)
{
    settings.likelihood = LikelihoodKind::Exponential;
    settings.snr = 1.0;
    return settings;
}

} // namespace

/// The sequential test of a line in a recording: no model of the settings loses probability, no frame counts twice.
class tst_lineSequentialModel : public QObject
{
    Q_OBJECT

private slots:
    void noModelLosesProbability_data()
    {
        QTest::addColumn<int>("lowest");
        QTest::addColumn<int>("highest");
        QTest::addColumn<std::vector<double>>("law");
        QTest::addColumn<int>("rounding");
        QTest::addColumn<int>("slopesPerBin");
        const std::vector<std::pair<const char *, std::vector<double>>> laws{{"third", {1.0 / 3.0, 1.0 / 3.0}},
                                                                             {"inert", {0.9, 0.05}},
                                                                             {"held", {1.0}},
                                                                             {"wide", {0.2, 0.2, 0.1, 0.1}},
                                                                             {"rounded", {0.3333334, 0.3333333}},
                                                                             {"always changed", {0.0, 0.5}}};
        for (const auto &[name, law] : laws)
            for (const auto &[lowest, highest] : {std::pair{-2, 2}, {0, 0}, {-4, 4}, {-1, 3}, {0, 2}, {-10, 10}})
                for (const Rounding rounding : {Rounding::HalfDown, Rounding::Trunc})
                    if (highest > lowest || law[0] > 0.5)
                        for (const int slopesPerBin : {1, 2, 8})
                            QTest::addRow("%s, %d … %d of 1/%d, %s", name, lowest, highest, slopesPerBin,
                                          roundingNames[std::size_t(rounding)].data())
                                << lowest << highest << law << int(rounding) << slopesPerBin;
    }

    void noModelLosesProbability()
    {
        // E0 e^λ = 1 in each cell, so E0[Λ_k] is Λ_k of no evidence at all: what is left of the target's probability.
        QFETCH(int, lowest);
        QFETCH(int, highest);
        QFETCH(std::vector<double>, law);
        QFETCH(int, rounding);
        QFETCH(int, slopesPerBin);
        ModelSettings settings;
        settings.lowestSlope = double(lowest) / slopesPerBin;
        settings.highestSlope = double(highest) / slopesPerBin;
        settings.slopesPerBin = slopesPerBin;
        settings.slopeChange = law;
        settings.rounding = static_cast<Rounding>(rounding);
        for (const Index cells : {1, 2, 5, 21, 41})
            for (const bool isCyclic : {false, true}) {
                if (isCyclic && (std::max(-lowest, highest) + slopesPerBin - 1) / slopesPerBin >= cells)
                    continue; // refused: a step goes round
                const Grid grid{{{"frequency", "Hz", 0.0, 1.0, cells, isCyclic}}};
                const FrameArray none({"time", "s", 0.0, 1.0, 1, false}, grid, std::vector<float>(std::size_t(cells)));
                LikelihoodRatio ratio(lineSequentialModel(settings, grid, none));
                const std::vector<double> lambda(std::size_t(cells), 0.0);
                for (int stage = 0; stage < 40; ++stage)
                    QVERIFY2(std::abs(ratio.update(lambda)) < 1e-12,
                             qPrintable(QString("%1 cells, stage %2: %3").arg(cells).arg(stage).arg(ratio.lnLambda())));
            }
    }

    void likelihoodRatiosHaveMeanOne_data()
    {
        QTest::addColumn<int>("kind");
        QTest::addColumn<double>("snr");
        for (const double snr : {0.1, 0.5, 1.0, 4.0}) {
            QTest::addRow("rice, %g", snr) << int(LikelihoodKind::Rice) << snr;
            QTest::addRow("exponential, %g", snr) << int(LikelihoodKind::Exponential) << snr;
            QTest::addRow("swerling4, %g", snr) << int(LikelihoodKind::Swerling4) << snr;
        }
    }

    void likelihoodRatiosHaveMeanOne()
    {
        QFETCH(int, kind);
        QFETCH(double, snr);
        const Likelihood likelihood(static_cast<LikelihoodKind>(kind), snr);
        const double mean = boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
            [&](double y) { return std::exp(likelihood.at(y) - y); }, 0.0, 400.0, 12, 1e-12);
        QVERIFY2(std::abs(mean - 1.0) < 1e-9, qPrintable(QString::number(mean - 1.0)));
    }

    void linearIsRefused()
    {
        ModelSettings settings;
        settings.likelihood = LikelihoodKind::Linear;
        const NormalisedFramesPointer noise = frames(1, 20);
        QVERIFY_THROWS_EXCEPTION(Error, lineSequentialModel(settings, noise->grid(), *noise));
        settings = {};
        settings.motion = Motion::Manoeuvring;
        QVERIFY_THROWS_EXCEPTION(Error, lineSequentialModel(settings, noise->grid(), *noise));
    }

    void framesThatShareNoSample()
    {
        for (const int steps : {1, 2, 4}) {
            const NormalisedFramesPointer made = frames(steps, 20);
            QCOMPARE(framesApart(*made), Index(steps));
            QCOMPARE(lineSequentialModel({}, made->grid(), *made).observedEvery, Index(steps));
        }
        const FrameArray ready({"time", "s", 0.0, 1.0, 2, false}, {{{"cell", "", 0.0, 1.0, 3, false}}},
                               std::vector<float>(6));
        QCOMPARE(framesApart(ready), Index(1));
    }

    void noiseIsNoTarget_data()
    {
        QTest::addColumn<int>("stepsPerWindow");
        for (const int steps : {1, 2, 4})
            QTest::addRow("%d frames a window", steps) << steps;
    }

    void noiseIsNoTarget()
    {
        // White noise through the whole front end.
        QFETCH(int, stepsPerWindow);
        const ModelSettings settings = exponential(stepsPerWindow == 2 ? ModelSettings() : laws::billon());
        const NormalisedFramesPointer noise = frames(stepsPerWindow, 4000);
        verify(along(noise, stepsPerWindow, settings));
        if (stepsPerWindow < 4)
            return;
        // Evidence that counts more than once: this is why the frames between are left out.
        const Counted all = along(noise, 1, settings);
        QVERIFY2(all.wrong > 0.1 * all.tests, qPrintable(QString("%1 of %2").arg(all.wrong).arg(all.tests)));
    }

    void targetsAreFound_data() { noiseIsNoTarget_data(); }

    void targetsAreFound()
    {
        // Targets of the model's law and its SNR in samples, their main lobes over several bins; the noise's level is
        // known.
        QFETCH(int, stepsPerWindow);
        SpectrogramSettings windows{.windowSeconds = windowSamples, .stepsPerWindow = stepsPerWindow};
        Counted counted;
        for (int run = 0; run < 300; ++run) {
            KinematicAxis slopes = makeModel(exponential(stepsPerWindow == 2 ? ModelSettings() : laws::billon()),
                                             {{{"frequency", "Hz", 0.0, 0.5 / windowSamples, band, false}}})
                                       .space.axes()[0];
            SequentialModel model =
                makeSequentialModel({slopes}, {false}, Likelihood(LikelihoodKind::Exponential, 1.0));
            model.observedEvery = stepsPerWindow;
            const Spectrogram spectrogram(targetInNoise(model, 300, std::uint64_t(run)), windows);
            const Index firstCell = spectrogram.frequency().nearest(0.0);
            std::vector<float> row(std::size_t(spectrogram.frequency().count));
            const SprtResult result =
                runSprt(model, {0.02, 0.02, 0}, spectrogram.time().count, [&](Index stage, std::span<double> y) {
                    spectrogram.read(stage, 1, row);
                    std::copy_n(row.begin() + firstCell, band, y.begin());
                });
            counted.tests += result.decision == SprtDecision::Undecided ? 0 : 1;
            counted.wrong += result.decision == SprtDecision::H0 ? 1 : 0;
        }
        verify(counted);
    }

    void partOfALine()
    {
        std::vector<float> values(5 * 10);
        std::iota(values.begin(), values.end(), 0.0f);
        const auto whole = std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 1.0, 5, false},
                                                        Grid{{{"frequency", "Hz", 0.0, 1.0, 10, false}}}, values);
        std::vector<double> y(3);
        stagesOf(whole, 2, 4, 3)(1, y); // frame 3, cells 4 … 6
        QCOMPARE(y, (std::vector<double>{34.0, 35.0, 36.0}));
    }
};

FAINTLINE_TEST(tst_lineSequentialModel)
#include "tst_lineSequentialModel.moc"
