#include "base/Random.h"
#include "detect/SumDetector.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;

namespace {

constexpr Index cells = 6;

MarkovModel model(double snr)
{
    return {StateSpace({{"a", cells, false, -1, 3, {0.5, 0.25}, {}, Rounding::HalfDown}}),
            Likelihood(LikelihoodKind::Rice, snr), 1.0};
}

double lnSum(double a, double b)
{
    const double high = std::max(a, b);
    return high == -std::numeric_limits<double>::infinity() ? high
                                                            : high + std::log(std::exp(a - high) + std::exp(b - high));
}

/// ln A of all states after the frames, by A(n, t) = e^λ (K Σ P(n|m) A(m, t-1) + 1), every term in logarithms.
std::vector<double> inLogarithms(const MarkovModel &m, const std::vector<std::vector<float>> &frames, double lnK)
{
    std::vector<double> ln;
    for (const std::vector<float> &y : frames) {
        std::vector<double> next(std::size_t(m.space.stateCount()), 0.0);
        for (Index n = 0; n < m.space.stateCount(); ++n) {
            double &sum = next[std::size_t(n)];
            if (!ln.empty())
                for (const StateSpace::Predecessor &p : m.space.predecessors(n))
                    sum = lnSum(sum, lnK + p.lnProbability + ln[std::size_t(p.state)]);
            sum += m.likelihood.at(double(y[std::size_t(m.space.cellOf(n))]));
        }
        ln = next;
    }
    return ln;
}

} // namespace

/// The sum over all paths where one frame's evidence is more than a double spans.
class tst_SumDetector : public QObject
{
    Q_OBJECT

private slots:
    void staysFiniteWhateverTheEvidence_data()
    {
        QTest::addColumn<double>("snr");
        QTest::addColumn<double>("lnK");
        QTest::addColumn<double>("power"); ///< of a strong signal in some frames
        QTest::newRow("far against") << 1000.0 << 0.0 << 0.0;
        QTest::newRow("far against, then for") << 1000.0 << 0.0 << 4000.0;
        QTest::newRow("fading") << 1000.0 << -0.5 << 20000.0;
        QTest::newRow("ordinary") << 0.5 << 0.0 << 12.0;
    }

    void staysFiniteWhateverTheEvidence()
    {
        QFETCH(double, snr);
        QFETCH(double, lnK);
        QFETCH(double, power);
        const MarkovModel m = model(snr);
        SumDetector detector(m, {ResetLaw::Fixed, lnK});
        std::vector<std::vector<float>> frames;
        Random random(5, 1);
        std::vector<float> statistic(cells);
        for (int t = 0; t < 12; ++t) {
            std::vector<float> y(cells);
            random.exponentials(y);
            if (t == 3 || t == 4)
                y[1] += float(power);
            if (t == 5) // out of the reach of the first one's paths
                y[5] += float(power);
            frames.push_back(y);
            detector.update(y, statistic);
            const std::vector<double> expected = inLogarithms(m, frames, lnK);
            const double best = *std::max_element(expected.begin(), expected.end());
            for (std::size_t n = 0; n < expected.size(); ++n) {
                const auto score = double(detector.scores()[n]);
                QVERIFY2(std::isfinite(score),
                         qPrintable(QStringLiteral("frame %1, state %2: %3").arg(t).arg(n).arg(score)));
                if (expected[n] > best - 600.0)
                    QVERIFY2(std::abs(score - expected[n]) < 1e-6 * std::max(1.0, std::abs(expected[n])),
                             qPrintable(QStringLiteral("frame %1, state %2: %3, not %4")
                                            .arg(t)
                                            .arg(n)
                                            .arg(score)
                                            .arg(expected[n])));
            }
            QVERIFY(std::isfinite(detector.lnMean()));
        }
    }
};

FAINTLINE_TEST(tst_SumDetector)
#include "tst_SumDetector.moc"
