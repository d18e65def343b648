#include "base/Random.h"
#include "base/logmath.h"
#include "evaluate/theory/waldTheory.h"
#include "support/test.h"

using namespace faintline;

namespace {

struct Counted {
    double mean = 0.0;
    double square = 0.0;
    double acceptH1 = 0.0;
};

/// Runs of the test for a known trajectory, drawn one after the other.
Counted simulateWalk(const SprtSettings &settings, double designSnr, double dataMean, int runs)
{
    Random random(21, 1);
    Counted counted;
    for (int run = 0; run < runs; ++run) {
        double lnLambda = 0.0;
        SprtDecision decision = SprtDecision::Undecided;
        int stage = 0;
        while (decision == SprtDecision::Undecided) {
            lnLambda += dataMean * random.exponential() * designSnr / (1.0 + designSnr) - std::log1p(designSnr);
            decision = decide(settings, lnLambda, ++stage);
        }
        counted.mean += double(stage) / runs;
        counted.square += double(stage) * stage / runs;
        counted.acceptH1 += decision == SprtDecision::H1 ? 1.0 / runs : 0.0;
    }
    return counted;
}

} // namespace

/// Wald's theory against simulation, against itself, and against a slower solution of the same equation.
class tst_waldTheory : public QObject
{
    Q_OBJECT

private slots:
    void divergencesByQuadrature_data()
    {
        QTest::addColumn<double>("snrDb");
        for (const double snrDb : {-15.0, -10.0, 0.0, 3.0, 12.0, 15.0})
            QTest::addRow("%g dB", snrDb) << snrDb;
    }

    void divergencesByQuadrature()
    {
        // One cell: the mixture is no mixture, and the closed form holds.
        QFETCH(double, snrDb);
        const Divergences closed = divergences(ratioFromDb(snrDb));
        const Divergences integral = mixtureDivergences(ratioFromDb(snrDb), 1);
        QVERIFY(std::abs(integral.h0 / closed.h0 - 1.0) < 1e-9);
        QVERIFY(std::abs(integral.h1 / closed.h1 - 1.0) < 1e-9);
    }

    void mixtureIsSimulated()
    {
        constexpr int cells = 8;
        constexpr double snr = 3.0;
        constexpr int runs = 100000;
        Random random(4, 4);
        double sum[2] = {};
        double squares[2] = {};
        for (int run = 0; run < runs; ++run)
            for (const bool isTarget : {false, true}) {
                double mean = 0.0;
                for (int cell = 0; cell < cells; ++cell)
                    mean +=
                        std::exp((cell == 0 && isTarget ? 1.0 + snr : 1.0) * random.exponential() * snr / (1.0 + snr))
                        / (1.0 + snr) / cells;
                sum[isTarget] += std::log(mean) / runs;
                squares[isTarget] += std::log(mean) * std::log(mean) / runs;
            }
        const Divergences found = mixtureDivergences(snr, cells);
        QVERIFY(std::abs(-sum[0] - found.h0) < 4.0 * std::sqrt((squares[0] - sum[0] * sum[0]) / runs));
        QVERIFY(std::abs(sum[1] - found.h1) < 4.0 * std::sqrt((squares[1] - sum[1] * sum[1]) / runs));
    }

    void boundsInOrder()
    {
        // The more cells, the less a stage says.
        WaldBounds before = waldBounds({}, 2.0, 1);
        QCOMPARE(before.h0High / before.h0Low, 1.0);
        for (const int cells : {2, 5, 30}) {
            const WaldBounds bounds = waldBounds({}, 2.0, cells);
            QCOMPARE(bounds.h0Low, before.h0Low);
            QVERIFY(bounds.h0High > before.h0High && bounds.h1High > before.h1High);
            before = bounds;
        }
    }

    void knownBounds()
    {
        // α = β = 1e-3, 0 dB: 0.998 ln 999 over 1 - ln 2 and ln 2 - ½.
        const WaldBounds bounds = waldBounds({}, 1.0, 1);
        QVERIFY(std::abs(bounds.h1Low - 0.998 * std::log(999.0) / (1.0 - std::log(2.0))) < 1e-9);
        QVERIFY(std::abs(bounds.h0Low - 0.998 * std::log(999.0) / (std::log(2.0) - 0.5)) < 1e-9);
    }

    void walkIsSimulated_data()
    {
        QTest::addColumn<double>("designDb");
        QTest::addColumn<double>("actualDb");
        QTest::newRow("0 dB") << 0.0 << 0.0;
        QTest::newRow("6 dB") << 6.0 << 6.0;
        QTest::newRow("weaker than designed for") << 6.0 << 2.0;
        QTest::newRow("stronger") << 0.0 << 5.0;
    }

    void walkIsSimulated()
    {
        QFETCH(double, designDb);
        QFETCH(double, actualDb);
        constexpr int runs = 20000;
        const SprtSettings settings{0.05, 0.02, 0};
        const DeterministicSprt exact = deterministicSprt(settings, ratioFromDb(designDb), ratioFromDb(actualDb));
        for (const bool isTarget : {false, true}) {
            const DeterministicSprt::Law &law = isTarget ? exact.h1 : exact.h0;
            const Counted counted =
                simulateWalk(settings, ratioFromDb(designDb), isTarget ? 1.0 + ratioFromDb(actualDb) : 1.0, runs);
            const double deviation = std::sqrt(counted.square - counted.mean * counted.mean);
            QVERIFY(std::abs(counted.mean - law.meanStages) < 4.0 * deviation / std::sqrt(runs));
            QVERIFY(std::abs(deviation / law.deviationStages - 1.0) < 0.05);
            QVERIFY(std::abs(counted.acceptH1 - law.acceptH1)
                    < 4.0 * std::sqrt(law.acceptH1 * (1.0 - law.acceptH1) / runs));
        }
    }

    void walkIsConsistent_data()
    {
        QTest::addColumn<double>("snrDb");
        for (const double snrDb : {-5.0, 0.0, 3.0, 10.0, 25.0})
            QTest::addRow("%g dB", snrDb) << snrDb;
    }

    void walkIsConsistent()
    {
        QFETCH(double, snrDb);
        const double snr = ratioFromDb(snrDb);
        const SprtSettings settings{1e-3, 1e-2, 0};
        const DeterministicSprt exact = deterministicSprt(settings, snr, snr);
        // It ends almost surely, by two equations that know nothing of each other.
        QVERIFY(std::abs(exact.h0.acceptH1 + exact.h0.acceptH0 - 1.0) < 1e-10);
        QVERIFY(std::abs(exact.h1.acceptH1 + exact.h1.acceptH0 - 1.0) < 1e-10);
        // Upward overshoots are exponential, without memory: with E1 e^{-overshoot} = 1/(1 + ρ) on a target the change of
        // measure from there to noise is exact, α = (1 - β) e^{-ln γ1}/(1 + ρ).
        const double change = std::exp(-sprtBoundaries(settings).lnUpper) / (1.0 + snr);
        QVERIFY(std::abs(exact.h0.acceptH1 / (exact.h1.acceptH1 * change) - 1.0) < 1e-9);
    }

    void walkByShooting_data()
    {
        QTest::addColumn<bool>("isTarget");
        QTest::newRow("noise") << false;
        QTest::newRow("target") << true;
    }

    void walkByShooting()
    {
        // With J(x) = ∫_x N(z) f-weight dz the equation reads N(x) = 1 + e^{(x-c-a)/s} J(x-c): from a guess of J at the
        // lower end a it can be gone through upwards, and as J at the upper end depends linearly on the guess, two guesses
        // give the right one. Trapezoids, two step widths.
        QFETCH(bool, isTarget);
        const SprtSettings settings{1e-3, 1e-3, 0};
        const double a = sprtBoundaries(settings).lnLower;
        const double b = sprtBoundaries(settings).lnUpper;
        const double c = std::log(2.0);
        const double s = isTarget ? 1.0 : 0.5;
        const auto shoot = [&](std::size_t perC, double guess, double &atZero) {
            const double h = c / double(perC);
            std::vector<double> N;
            std::vector<double> J;
            for (double x = a; J.empty() || x < b + h; x = a + double(J.size()) * h) {
                const double end = std::min(x, b);
                double delayed = guess; // J at x - c, or at a
                if (J.size() > perC) {
                    const double t = (end - c - a) / h;
                    const auto k = std::min(std::size_t(t), J.size() - 2);
                    delayed = std::lerp(J[k], J[k + 1], t - double(k));
                }
                N.push_back(1.0 + std::exp((end - c - a) / s) * delayed);
                if (J.empty()) {
                    J.push_back(guess);
                    continue;
                }
                const double start = a + double(J.size() - 1) * h;
                J.push_back(J.back()
                            - 0.5 * (N[N.size() - 2] * std::exp(-(start - a) / s) + N.back() * std::exp(-(end - a) / s))
                                  / s * (end - start));
                if (end == b)
                    break;
            }
            const double t = -a / h;
            const auto k = std::size_t(t);
            const double f = t - double(k);
            atZero = -f * (f - 1.0) * (f - 2.0) / 6.0 * N[k - 1] + (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0 * N[k]
                     - (f + 1.0) * f * (f - 2.0) / 2.0 * N[k + 1] + (f + 1.0) * f * (f - 1.0) / 6.0 * N[k + 2];
            return J.back();
        };
        const auto stages = [&](std::size_t perC) {
            double atZero = 0.0;
            const double without = shoot(perC, 0.0, atZero);
            const double with = shoot(perC, 1.0, atZero);
            shoot(perC, -without / (with - without), atZero);
            return atZero;
        };
        const double extrapolated = (4.0 * stages(1600) - stages(800)) / 3.0;
        const DeterministicSprt exact = deterministicSprt(settings, 1.0, 1.0);
        const double found = isTarget ? exact.h1.meanStages : exact.h0.meanStages;
        QVERIFY2(std::abs(found - extrapolated) < 5e-6,
                 qPrintable(QString("%1 against %2").arg(found, 0, 'f', 9).arg(extrapolated, 0, 'f', 9)));
    }

    void errorsStayBelowTheirBounds()
    {
        const SprtSettings settings{1e-3, 1e-3, 0};
        const DeterministicSprt exact = deterministicSprt(settings, 1.0, 1.0);
        const SprtBoundaries at = sprtBoundaries(settings);
        QVERIFY(exact.h0.acceptH1 <= std::exp(-at.lnUpper));
        QVERIFY(exact.h1.acceptH0 <= std::exp(at.lnLower));
        // Overshoot costs stages: Wald's approximation is a lower bound here.
        QVERIFY(exact.h0.meanStages > waldBounds(settings, 1.0, 1).h0Low);
        QVERIFY(exact.h1.meanStages > waldBounds(settings, 1.0, 1).h1Low);
    }

    void fixedSize()
    {
        // One stage: P(y > T) = α at T = -ln α, P(miss) = 1 - α^{1/(1+ρ)} ≤ β.
        const double needed = std::log(0.01) / std::log1p(-0.05) - 1.0; // the SNR at which one stage is just enough
        QCOMPARE(fixedSampleSize({0.01, 0.05, 0}, needed * 1.001), Index(1));
        QCOMPARE(fixedSampleSize({0.01, 0.05, 0}, needed * 0.999), Index(2));
        QVERIFY(fixedSampleSize({}, 1.0) > 2 * Index(deterministicSprt({}, 1.0, 1.0).h0.meanStages));
    }

    void refusals()
    {
        QVERIFY_EXCEPTION_THROWN(divergences(0.0), Error);
        QVERIFY_EXCEPTION_THROWN(mixtureDivergences(1.0, 0), Error);
        QVERIFY_EXCEPTION_THROWN(deterministicSprt({}, 1e-4, 1e-4), Error);
        QVERIFY_EXCEPTION_THROWN(deterministicSprt({0.7, 0.1, 0}, 1.0, 1.0), Error);
    }
};

FAINTLINE_TEST(tst_waldTheory)
#include "tst_waldTheory.moc"
