#include "base/Random.h"
#include "base/logmath.h"
#include "evaluate/waldTheory.h"

#include <QtTest>

using namespace faintline;

/// Wald's theory against simulation, against itself, and against a slower solution of the same equation.
class tst_waldTheory : public QObject
{
    Q_OBJECT

private slots:
    void divergencesByQuadrature_data();
    void divergencesByQuadrature();
    void mixtureIsSimulated();
    void boundsInOrder();
    void knownBounds();
    void walkIsSimulated_data();
    void walkIsSimulated();
    void walkIsConsistent_data();
    void walkIsConsistent();
    void walkOnAGrid();
    void errorsStayBelowTheirBounds();
    void fixedSize();
    void refusals();
};

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
        counted.mean += static_cast<double>(stage) / runs;
        counted.square += static_cast<double>(stage) * stage / runs;
        counted.acceptH1 += decision == SprtDecision::H1 ? 1.0 / runs : 0.0;
    }
    return counted;
}

} // namespace

void tst_waldTheory::divergencesByQuadrature_data()
{
    QTest::addColumn<double>("snrDb");
    for (const double snrDb : {-15.0, -10.0, 0.0, 3.0, 12.0, 20.0})
        QTest::addRow("%g dB", snrDb) << snrDb;
}

void tst_waldTheory::divergencesByQuadrature()
{
    // One cell: the mixture is no mixture, and the closed form holds.
    QFETCH(double, snrDb);
    const Divergences closed = divergences(ratioFromDb(snrDb));
    const Divergences integral = mixtureDivergences(ratioFromDb(snrDb), 1);
    QVERIFY(std::abs(integral.h0 / closed.h0 - 1.0) < 1e-9);
    QVERIFY(std::abs(integral.h1 / closed.h1 - 1.0) < 1e-9);
}

void tst_waldTheory::mixtureIsSimulated()
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
                mean += std::exp((cell == 0 && isTarget ? 1.0 + snr : 1.0) * random.exponential() * snr / (1.0 + snr)) / (1.0 + snr) / cells;
            sum[isTarget] += std::log(mean) / runs;
            squares[isTarget] += std::log(mean) * std::log(mean) / runs;
        }
    const Divergences found = mixtureDivergences(snr, cells);
    QVERIFY(std::abs(-sum[0] - found.h0) < 4.0 * std::sqrt((squares[0] - sum[0] * sum[0]) / runs));
    QVERIFY(std::abs(sum[1] - found.h1) < 4.0 * std::sqrt((squares[1] - sum[1] * sum[1]) / runs));
}

void tst_waldTheory::boundsInOrder()
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

void tst_waldTheory::knownBounds()
{
    // α = β = 1e-3, 0 dB: 0.998 ln 999 over 1 - ln 2 and ln 2 - ½.
    const WaldBounds bounds = waldBounds({}, 1.0, 1);
    QVERIFY(std::abs(bounds.h1Low - 0.998 * std::log(999.0) / (1.0 - std::log(2.0))) < 1e-9);
    QVERIFY(std::abs(bounds.h0Low - 0.998 * std::log(999.0) / (std::log(2.0) - 0.5)) < 1e-9);
}

void tst_waldTheory::walkIsSimulated_data()
{
    QTest::addColumn<double>("designDb");
    QTest::addColumn<double>("actualDb");
    QTest::newRow("0 dB") << 0.0 << 0.0;
    QTest::newRow("6 dB") << 6.0 << 6.0;
    QTest::newRow("weaker than designed for") << 6.0 << 2.0;
    QTest::newRow("stronger") << 0.0 << 5.0;
}

void tst_waldTheory::walkIsSimulated()
{
    QFETCH(double, designDb);
    QFETCH(double, actualDb);
    constexpr int runs = 20000;
    const SprtSettings settings{0.05, 0.02, 0};
    const DeterministicSprt exact = deterministicSprt(settings, ratioFromDb(designDb), ratioFromDb(actualDb));
    for (const bool isTarget : {false, true}) {
        const DeterministicSprt::Law &law = isTarget ? exact.h1 : exact.h0;
        const Counted counted = simulateWalk(settings, ratioFromDb(designDb), isTarget ? 1.0 + ratioFromDb(actualDb) : 1.0, runs);
        const double deviation = std::sqrt(counted.square - counted.mean * counted.mean);
        QVERIFY(std::abs(counted.mean - law.meanStages) < 4.0 * deviation / std::sqrt(runs));
        QVERIFY(std::abs(deviation / law.deviationStages - 1.0) < 0.05);
        QVERIFY(std::abs(counted.acceptH1 - law.acceptH1) < 4.0 * std::sqrt(law.acceptH1 * (1.0 - law.acceptH1) / runs));
    }
}

void tst_waldTheory::walkIsConsistent_data()
{
    QTest::addColumn<double>("snrDb");
    for (const double snrDb : {-8.0, 0.0, 3.0, 10.0, 25.0})
        QTest::addRow("%g dB", snrDb) << snrDb;
}

void tst_waldTheory::walkIsConsistent()
{
    QFETCH(double, snrDb);
    const double snr = ratioFromDb(snrDb);
    const SprtSettings settings{1e-3, 1e-2, 0};
    const DeterministicSprt exact = deterministicSprt(settings, snr, snr);
    // It ends almost surely, by two equations that know nothing of each other.
    QVERIFY(std::abs(exact.h0.acceptH1 + exact.h0.acceptH0 - 1.0) < 1e-10);
    QVERIFY(std::abs(exact.h1.acceptH1 + exact.h1.acceptH0 - 1.0) < 1e-10);
    // Upward overshoots are exponential, without memory: with E1 e^{-overshoot} = 1/(1 + ρ) on a target the change of measure from there
    // to noise is exact, α = (1 - β) e^{-ln γ1}/(1 + ρ).
    const double change = std::exp(-sprtBoundaries(settings).lnUpper) / (1.0 + snr);
    QVERIFY(std::abs(exact.h0.acceptH1 / (exact.h1.acceptH1 * change) - 1.0) < 1e-9);
}

void tst_waldTheory::walkOnAGrid()
{
    // The same equation by a plain midpoint rule over a fine grid, iterated; its error falls with the square of the step but for the
    // jump of the density, so two grids are extrapolated.
    const SprtSettings settings{0.05, 0.05, 0};
    constexpr double snr = 1.0;
    const SprtBoundaries at = sprtBoundaries(settings);
    const auto plain = [&](int perC) {
        const double c = std::log1p(snr);
        const double h = c / perC;
        const auto n = static_cast<std::size_t>(std::round((at.lnUpper - at.lnLower) / h));
        // Start at ln γ0 + n·h so that 0 is a midpoint's neighbour; what is wanted is N at the midpoint nearest to 0.
        std::vector<double> value(n, 0.0);
        std::vector<double> next(n);
        for (int round = 0; round < 400; ++round) {
            for (std::size_t i = 0; i < n; ++i) {
                double sum = 1.0;
                for (std::size_t j = i > static_cast<std::size_t>(perC) ? i - static_cast<std::size_t>(perC) : 0; j < n; ++j) {
                    const double d = (static_cast<double>(j) - static_cast<double>(i)) * h + c;
                    const double mass = d == 0.0 ? -std::expm1(-h) : d < 0.5 * h ? -std::expm1(-h) : std::exp(-2.0 * (d - 0.5 * h)) - std::exp(-2.0 * (d + 0.5 * h));
                    sum += value[j] * mass;
                }
                next[i] = sum;
            }
            value.swap(next);
        }
        const auto zero = static_cast<std::size_t>(-at.lnLower / h);
        return value[zero];
    };
    const double exact = deterministicSprt(settings, snr, snr).h0.meanStages;
    const double coarse = plain(20);
    const double fine = plain(40);
    QVERIFY2(std::abs(2.0 * fine - coarse - exact) < 0.02 * exact, qPrintable(QString("%1 %2 against %3").arg(coarse).arg(fine).arg(exact)));
}

void tst_waldTheory::errorsStayBelowTheirBounds()
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

void tst_waldTheory::fixedSize()
{
    // One stage: P(y > T) = α at T = -ln α, P(miss) = 1 - α^{1/(1+ρ)} ≤ β.
    const double needed = std::log(0.01) / std::log1p(-0.05) - 1.0; // the SNR at which one stage is just enough
    QCOMPARE(fixedSampleSize({0.01, 0.05, 0}, needed * 1.001), Index(1));
    QCOMPARE(fixedSampleSize({0.01, 0.05, 0}, needed * 0.999), Index(2));
    QVERIFY(fixedSampleSize({}, 1.0) > 2 * static_cast<Index>(deterministicSprt({}, 1.0, 1.0).h0.meanStages));
}

void tst_waldTheory::refusals()
{
    QVERIFY_EXCEPTION_THROWN(divergences(0.0), Error);
    QVERIFY_EXCEPTION_THROWN(mixtureDivergences(1.0, 0), Error);
    QVERIFY_EXCEPTION_THROWN(deterministicSprt({}, 1e-4, 1e-4), Error);
    QVERIFY_EXCEPTION_THROWN(deterministicSprt({0.7, 0.1, 0}, 1.0, 1.0), Error);
}

QTEST_APPLESS_MAIN(tst_waldTheory)
#include "tst_waldTheory.moc"
