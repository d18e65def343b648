#include "evaluate/theory/theory.h"
#include "support/test.h"

#include "base/Random.h"
#include "detect/Integrator.h"
#include "evaluate/experiments/LineTrials.h"

#include <algorithm>
#include <cmath>

using namespace faintline;

namespace {

constexpr std::array fluctuating{Fluctuation::Swerling1, Fluctuation::Swerling2, Fluctuation::Swerling3,
                                 Fluctuation::Swerling4};

QString nameOf(Fluctuation fluctuation)
{
    return QString::fromStdString(std::string(fluctuationNames[std::size_t(fluctuation)]));
}

/// Pd as a mixture. Given the power, the sum of N cells has a gamma law of shape N + J with J of Poisson's law; over a
/// gamma-distributed power J has the negative binomial law, of shape 1 (Swerling 1), N (2), 2 (3) and 2N (4). Plain
/// sums, term by term.
double pdOfMixture(double threshold, int looks, double snr, Fluctuation fluctuation)
{
    const double shape = fluctuation == Fluctuation::Swerling1   ? 1.0
                         : fluctuation == Fluctuation::Swerling2 ? looks
                         : fluctuation == Fluctuation::Swerling3 ? 2.0
                                                                 : 2.0 * looks;
    const double v = looks * threshold;
    const double p = shape / (shape + looks * snr);
    const auto density = [v](int n) { return std::exp(-v + n * std::log(v) - std::lgamma(n + 1.0)); };
    double tail = 0.0; // of the gamma law of shape N + j
    for (int i = 0; i < looks; ++i)
        tail += density(i);
    double lnWeight = shape * std::log(p);
    double sum = 0.0;
    const int most = int(60.0 * (looks * snr + 1.0)) + 200;
    for (int j = 0; j < most; ++j) {
        sum += std::exp(lnWeight) * tail;
        tail += density(looks + j);
        lnWeight += std::log((shape + j) / (j + 1.0) * (1.0 - p));
    }
    return sum;
}

/// Powers of `cells` cells with a target each, one frame after the other: a complex amplitude √(g·snr) in complex
/// noise.
class Targets
{
public:
    Targets(Fluctuation fluctuation, double snr, std::size_t cells, std::uint64_t stream)
        : m_fluctuation(fluctuation), m_snr(snr), m_random(71, stream), m_powers(cells), m_noise(2 * cells)
    {
        draw();
    }

    void next(std::vector<float> &y)
    {
        m_random.normals(m_noise, std::sqrt(0.5f));
        if (changesFromFrameToFrame(m_fluctuation))
            draw();
        for (std::size_t i = 0; i < y.size(); ++i) {
            const float re = m_noise[2 * i] + float(std::sqrt(m_powers[i] * m_snr));
            y[i] = re * re + m_noise[2 * i + 1] * m_noise[2 * i + 1];
        }
    }

private:
    void draw()
    {
        const bool isExponential = m_fluctuation == Fluctuation::Swerling1 || m_fluctuation == Fluctuation::Swerling2;
        for (double &power : m_powers) // from the logarithms of uniforms, not from relativePower
            power = isExponential ? -std::log(m_random.uniform())
                                  : -0.5 * std::log(m_random.uniform() * m_random.uniform());
    }

    Fluctuation m_fluctuation;
    double m_snr;
    Random m_random;
    std::vector<double> m_powers;
    std::vector<float> m_noise;
};

void verifyShare(std::int64_t found, std::int64_t trials, double pd, const QString &what)
{
    const double share = double(found) / double(trials);
    const double error = std::sqrt(pd * (1.0 - pd) / double(trials));
    QVERIFY2(std::abs(share - pd) < 4.5 * error, qPrintable(QString("%1: %2, theory %3").arg(what).arg(share).arg(pd)));
}

/// Lines of twenty windows in frames that do not overlap, twenty in a run.
Experiment lineExperiment(Fluctuation fluctuation)
{
    return {.seed = 5,
            .frames = 60,
            .blockFrames = 30,
            .blockBins = 100,
            .stepsPerWindow = 1,
            .durationSeconds = 20.0,
            .fluctuation = fluctuation};
}

/// Mean power of a line's own cells over its frames.
template <class PowerAt>
double meanAlong(const Experiment &lines, const Place &place, PowerAt powerAt)
{
    double sum = 0.0;
    for (std::size_t k = 0; k < place.bins.size(); ++k)
        sum += powerAt(std::size_t((place.firstFrame + Index(k)) * lines.bins() + place.bins[k]));
    return sum / double(place.bins.size());
}

} // namespace

/// Detection probabilities of Swerling's targets against textbooks, sums and simulations that share no code with them.
class tst_swerling : public QObject
{
    Q_OBJECT

private slots:
    void onePulse()
    {
        for (const double pfa : {1e-2, 1e-6, 1e-10})
            for (const double snr : {0.01, 1.0, 30.0, 1e4}) {
                const double threshold = thresholdOfMeanPower(pfa, 1);
                const double pd = std::pow(pfa, 1.0 / (1.0 + snr));
                QVERIFY(std::abs(pdOfMeanPower(threshold, 1, snr, Fluctuation::Swerling1) - pd) < 1e-12);
                QVERIFY(std::abs(pdOfMeanPower(threshold, 1, snr, Fluctuation::Swerling2) - pd) < 1e-12);
                // One pulse is one frame and one look: cases 3 and 4 are the same.
                const double pd3 = pdOfMeanPower(threshold, 1, snr, Fluctuation::Swerling3);
                QVERIFY(std::abs(pd3 - pdOfMeanPower(threshold, 1, snr, Fluctuation::Swerling4)) < 1e-12);
                QVERIFY(std::abs(pd3 - pdOfMixture(threshold, 1, snr, Fluctuation::Swerling3)) < 1e-9);
            }
    }

    void textbookSnrs()
    {
        // The usual example, Pd 0.9 at Pfa 1e-6: 13.2 dB without fluctuation, 21.1 dB for case 1, a fluctuation loss of
        // 8 dB.
        const double threshold = thresholdOfMeanPower(1e-6, 1);
        QVERIFY(std::abs(pdOfMeanPower(threshold, 1, std::pow(10.0, 1.318), Fluctuation::None) - 0.9) < 0.003);
        QVERIFY(std::abs(pdOfMeanPower(threshold, 1, std::pow(10.0, 2.114), Fluctuation::Swerling1) - 0.9) < 0.001);
        // Case 2, ten pulses: the threshold scales with 1 + snr (DiFranco and Rubin).
        const double t = thresholdOfMeanPower(1e-6, 10);
        QVERIFY(std::abs(pdOfMeanPower(t, 10, 2.0, Fluctuation::Swerling2) - pfaOfMeanPower(t / 3.0, 10)) < 1e-14);
    }

    void limits()
    {
        for (const Fluctuation fluctuation : fluctuating)
            for (const int looks : {1, 2, 3, 40}) {
                const double threshold = thresholdOfMeanPower(1e-4, looks);
                const auto pd = [&](double snr) { return pdOfMeanPower(threshold, looks, snr, fluctuation); };
                QVERIFY(std::abs(pd(0.0) - 1e-4) < 1e-12);
                QVERIFY(std::abs(pd(1e-9) - 1e-4) < 1e-9);
                QVERIFY(pd(1e8) > 0.999999 && pd(1e8) <= 1.0 + 1e-12);
                for (double snr = 1e-3; snr < 1e4; snr *= 1.5)
                    QVERIFY(pd(1.5 * snr) >= pd(snr) - 1e-12); // rounding near 1
                QCOMPARE(pdOfMeanPower(0.0, looks, 1.0, fluctuation), 1.0);
            }
        QCOMPARE(pdOfMeanPower(1.4, 20, 0.5, Fluctuation::None), pdOfMeanPower(1.4, 20, 0.5));
        QCOMPARE(pdOfPofN(3, 4, 2.0, 0.5, Fluctuation::None), pdOfPofN(3, 4, pdOfMeanPower(2.0, 1, 0.5)));
    }

    void mixtures()
    {
        // Up to many looks and on both sides of z = n + 1, where the form changes.
        for (const Fluctuation fluctuation : fluctuating)
            for (const int looks : {1, 2, 3, 10, 100, 600})
                for (const double pfa : {1e-1, 1e-6})
                    for (const double snr : {1e-3, 0.03, 0.3, 1.0, 5.0}) {
                        const double threshold = thresholdOfMeanPower(pfa, looks);
                        const double pd = pdOfMeanPower(threshold, looks, snr, fluctuation);
                        const double expected = pdOfMixture(threshold, looks, snr, fluctuation);
                        QVERIFY2(std::abs(pd - expected) < 1e-9 * std::max(1e-3, expected) + 1e-11,
                                 qPrintable(QString("%1, %2 looks, Pfa %3, SNR %4: %5, expected %6")
                                                .arg(nameOf(fluctuation))
                                                .arg(looks)
                                                .arg(pfa)
                                                .arg(snr)
                                                .arg(pd, 0, 'g', 14)
                                                .arg(expected, 0, 'g', 14)));
                    }
    }

    void integrator()
    {
        // The detector itself on drawn targets.
        constexpr Index trials = 20000;
        std::uint64_t stream = 0;
        for (const Fluctuation fluctuation : fluctuating)
            for (const int looks : {1, 10, 60})
                for (const double snr : {0.3, 2.0}) {
                    Targets targets(fluctuation, snr, trials, stream++);
                    Integrator detector(trials, IntegratorSettings::Shape::Boxcar, looks);
                    std::vector<float> y(trials);
                    std::vector<float> mean(trials);
                    for (int look = 0; look < looks; ++look) {
                        targets.next(y);
                        detector.update(y, mean);
                    }
                    const double threshold = thresholdOfMeanPower(0.01, looks);
                    const auto found =
                        std::count_if(mean.begin(), mean.end(), [&](float value) { return double(value) > threshold; });
                    verifyShare(found, trials, pdOfMeanPower(threshold, looks, snr, fluctuation),
                                QString("%1, %2 looks, SNR %3").arg(nameOf(fluctuation)).arg(looks).arg(snr));
                }
    }

    void pOfN()
    {
        constexpr Index trials = 40000;
        constexpr double threshold = 3.0;
        std::uint64_t stream = 100;
        for (const Fluctuation fluctuation : fluctuating)
            for (const auto &[p, n] : {std::pair{1, 1}, std::pair{3, 4}, std::pair{6, 8}, std::pair{2, 9}})
                for (const double snr : {1.0, 8.0}) {
                    Targets targets(fluctuation, snr, trials, stream++);
                    std::vector<float> y(trials);
                    std::vector<int> frames(trials, 0);
                    for (int frame = 0; frame < n; ++frame) {
                        targets.next(y);
                        for (std::size_t i = 0; i < y.size(); ++i)
                            frames[i] += double(y[i]) > threshold ? 1 : 0;
                    }
                    const int least = p;
                    const auto found = std::count_if(frames.begin(), frames.end(), [&](int k) { return k >= least; });
                    verifyShare(found, trials, pdOfPofN(p, n, threshold, snr, fluctuation),
                                QString("%1, %2 of %3, SNR %4").arg(nameOf(fluctuation)).arg(p).arg(n).arg(snr));
                }
        // One frame of one has the tail of one pulse.
        QVERIFY(std::abs(pdOfPofN(1, 1, 3.0, 2.0, Fluctuation::Swerling1) - std::exp(-1.0)) < 1e-9);
    }

    // Lines from the samples on: what an experiment simulates has the probability of theory. Between two bins a line's mean
    // power is a little less; it is taken from the same line without fluctuation.
    void simulatedLines()
    {
        constexpr int runs = 100;
        constexpr int looks = 20;
        constexpr double snr = 0.5;
        const double threshold = thresholdOfMeanPower(1e-3, looks);
        std::vector<NoisyField> constant;
        for (int run = 0; run < runs; ++run)
            constant.push_back(makeField(lineExperiment(Fluctuation::None), run));
        for (const Fluctuation fluctuation : fluctuating) {
            const Experiment lines = lineExperiment(fluctuation);
            std::int64_t found = 0;
            std::int64_t trials = 0;
            double pd = 0.0;
            for (int run = 0; run < runs; ++run) {
                const NoisyField field = makeField(lines, run);
                const NoisyField &steady = constant[std::size_t(run)];
                for (const Place &place : steady.places) {
                    const double share =
                        meanAlong(lines, place, [&](std::size_t at) { return double(std::norm(steady.signal[at])); });
                    const double mean = meanAlong(lines, place, [&](std::size_t at) {
                        return double(std::norm(field.noise[at] + float(std::sqrt(snr)) * field.signal[at]));
                    });
                    pd += pdOfMeanPower(threshold, looks, snr * share, fluctuation);
                    found += mean > threshold ? 1 : 0;
                    ++trials;
                }
            }
            QCOMPARE(trials, std::int64_t(2000));
            verifyShare(found, trials, pd / double(trials), nameOf(fluctuation));
        }
    }
};

FAINTLINE_TEST(tst_swerling)
#include "tst_swerling.moc"
