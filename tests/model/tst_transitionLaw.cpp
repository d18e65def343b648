#include "model/transitionLaw.h"
#include "support/test.h"

#include "base/Random.h"
#include "detect/Smd.h"

#include <cmath>
#include <numbers>
#include <numeric>

using namespace faintline;

namespace {

double total(const std::vector<double> &law)
{
    return 2.0 * std::accumulate(law.begin(), law.end(), 0.0) - law.front();
}

/// Powers of cells with a signal of constant amplitude, one frame.
void signalFrame(Random &random, double snr, std::vector<float> &y)
{
    for (float &value : y) {
        const double re = std::sqrt(snr) + random.normal() * std::numbers::sqrt2 / 2.0;
        const double im = random.normal() * std::numbers::sqrt2 / 2.0;
        value = float(re * re + im * im);
    }
}

/// Paths that stay where they are and pay ln 3 a step, each on a signal: what their mean statistic gains in a frame,
/// once settled, and the standard error of that.
std::pair<double, double> growth(const Likelihood &likelihood, double snr, double lnK)
{
    constexpr std::size_t cells = 2000;
    constexpr int settle = 200;
    constexpr int frames = 200;
    MarkovModel model{StateSpace({{"frequency", cells, false, 0, 1, {1.0 / 3.0, 1.0 / 3.0}, {}}}), likelihood, 1.0};
    Smd smd(model, {ResetLaw::Fixed, lnK});
    Random random(7, 1);
    std::vector<float> y(cells);
    std::vector<float> before(cells);
    std::vector<float> after(cells);
    for (int frame = 0; frame < settle + frames; ++frame) {
        signalFrame(random, snr, y);
        smd.update(y, frame < settle ? before : after);
    }
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < cells; ++i) {
        const double gain = double(after[i] - before[i]) / frames;
        sum += gain;
        squares += gain * gain;
    }
    const double mean = sum / cells;
    return {mean, std::sqrt((squares / cells - mean * mean) / cells)};
}

} // namespace

class tst_transitionLaw : public QObject
{
    Q_OBJECT

private slots:
    void othersKeepTheirProportions()
    {
        // By eye: {½, ⅛, ⅛}, h(0) to ¾: a quarter is left for what had a half.
        const std::vector<double> law = withProbability({0.5, 0.125, 0.125}, 0, 0.75);
        QCOMPARE(law, (std::vector<double>{0.75, 0.0625, 0.0625}));
        // h(1) to ¼, which both signs take: a half is left for what had three quarters.
        const std::vector<double> other = withProbability({0.5, 0.125, 0.125}, 1, 0.25);
        QCOMPARE(other[1], 0.25);
        QVERIFY(std::abs(other[0] - 1.0 / 3.0) < 1e-15 && std::abs(other[2] - 1.0 / 12.0) < 1e-15);
    }

    void aLawStaysALaw()
    {
        Random random(3, 1);
        std::vector<double> law{1.0};
        for (int i = 0; i < 2000; ++i) {
            law = withProbability(law, random.bits() % 4, 1.4 * random.uniform() - 0.2);
            QVERIFY(std::abs(total(law) - 1.0) < 1e-9);
            for (const double h : law)
                QVERIFY(h >= 0.0 && h <= 1.0);
            QVERIFY(law.size() == 1 || law.back() > 0.0);
        }
    }

    void fromOnePossibilityToAnother()
    {
        QCOMPARE(withProbability({1.0}, 0, 0.5), (std::vector<double>{0.5, 0.25}));
        QCOMPARE(withProbability({1.0}, 2, 0.125), (std::vector<double>{0.75, 0.0, 0.125}));
        QCOMPARE(withProbability({0.5, 0.25}, 1, 0.0), (std::vector<double>{1.0}));
        QCOMPARE(withProbability({0.0, 0.5}, 1, 0.25), (std::vector<double>{0.5, 0.25}));
        QCOMPARE(withProbability({0.5, 0.25}, 0, 7.0), (std::vector<double>{1.0}));
    }

    void dampingByEye()
    {
        const LawDamping third = damping({1.0 / 3.0, 1.0 / 3.0});
        QVERIFY(std::abs(third.likeliest - std::log(3.0)) < 1e-12);
        QVERIFY(std::abs(third.unlikeliest - std::log(3.0)) < 1e-12);
        QVERIFY(std::abs(third.mean - std::log(3.0)) < 1e-12);
        const LawDamping peaked = damping({0.5, 0.0, 0.25});
        QVERIFY(std::abs(peaked.likeliest - std::log(2.0)) < 1e-12);
        QVERIFY(std::abs(peaked.unlikeliest - std::log(4.0)) < 1e-12);
        QVERIFY(std::abs(peaked.mean - 1.5 * std::log(2.0)) < 1e-12);
        QCOMPARE(damping({1.0}).mean, 0.0);
    }

    void meanEvidenceIsThatOfDrawnFrames()
    {
        for (const double snr : {0.1, 0.5, 3.0, 40.0}) {
            const Likelihood likelihood(LikelihoodKind::Rice, 0.5);
            std::vector<float> y(100000);
            std::vector<float> lambda(y.size());
            Random random(11, 2);
            signalFrame(random, snr, y);
            likelihood.apply(y, lambda);
            double sum = 0.0;
            double squares = 0.0;
            for (const float value : lambda) {
                sum += double(value);
                squares += double(value) * double(value);
            }
            const auto count = double(y.size());
            const double mean = sum / count;
            const double error = std::sqrt((squares / count - mean * mean) / count);
            QVERIFY2(std::abs(meanEvidence(likelihood, snr) - mean) < 5.0 * error, qPrintable(QString::number(snr)));
        }
        // E λ = (1 + SNR)·ρ/(1 + ρ) - ln(1 + ρ)
        QVERIFY(std::abs(meanEvidence(Likelihood(LikelihoodKind::Exponential, 2.0), 5.0) - (4.0 - std::log(3.0)))
                < 1e-12);
        QCOMPARE(meanEvidence(Likelihood(LikelihoodKind::Linear), 5.0), 6.0);
    }

    void meanEvidenceOfAFluctuatingPower()
    {
        // An amplitude √(g·SNR) in complex noise, with g of χ² with 4 degrees of freedom.
        const Likelihood likelihood(LikelihoodKind::Swerling4, 2.0);
        for (const double snr : {0.1, 1.0, 5.0, 100.0}) {
            Random random(12, 3);
            double sum = 0.0;
            double squares = 0.0;
            constexpr int count = 200000;
            for (int i = 0; i < count; ++i) {
                const double g = 0.5 * (random.exponential() + random.exponential());
                const double re = std::sqrt(g * snr) + random.normal() * std::numbers::sqrt2 / 2.0;
                const double im = random.normal() * std::numbers::sqrt2 / 2.0;
                const double lambda = likelihood.at(re * re + im * im);
                sum += lambda;
                squares += lambda * lambda;
            }
            const double mean = sum / count;
            const double error = std::sqrt((squares / count - mean * mean) / count);
            QVERIFY2(std::abs(meanEvidence(likelihood, snr) - mean) < 5.0 * error, qPrintable(QString::number(snr)));
        }
        const double snr = lowestIntegratedSnr(likelihood, 0.3);
        QVERIFY(std::abs(meanEvidence(likelihood, snr) - 0.3) < 1e-9);
    }

    void lowestSnrIsWhereTheMeanBalances()
    {
        QVERIFY(std::abs(lowestIntegratedSnr(Likelihood(LikelihoodKind::Linear), 3.5) - 2.5) < 1e-6);
        QCOMPARE(lowestIntegratedSnr(Likelihood(LikelihoodKind::Linear), 0.9), 0.0);
        const Likelihood rice(LikelihoodKind::Rice, 0.5);
        const double snr = lowestIntegratedSnr(rice, 0.3);
        QVERIFY(std::abs(meanEvidence(rice, snr) - 0.3) < 1e-9);
    }

    void belowItPathsAreResetAboveItTheyGrow()
    {
        const Likelihood rice(LikelihoodKind::Rice, 0.5);
        constexpr double lnK = 0.9;
        const double loss = std::log(3.0) - lnK;
        const double lowest = lowestIntegratedSnr(rice, loss);
        QVERIFY(lowest > 0.3 && lowest < 3.0);
        const double above = 1.5 * lowest;
        const auto [up, upError] = growth(rice, above, lnK);
        QVERIFY2(std::abs(up - (meanEvidence(rice, above) - loss)) < 5.0 * upError, qPrintable(QString::number(up)));
        const auto [down, downError] = growth(rice, lowest / 1.5, lnK);
        QVERIFY2(std::abs(down) < 5.0 * downError, qPrintable(QString::number(down)));
    }
};

FAINTLINE_TEST(tst_transitionLaw)
#include "tst_transitionLaw.moc"
