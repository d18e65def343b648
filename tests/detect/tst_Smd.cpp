#include "base/Random.h"
#include "detect/Smd.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;

namespace {

MarkovModel stable(Index cells, LikelihoodKind kind = LikelihoodKind::Linear)
{
    return {StateSpace({{"f", cells, true, 0, 1, {1.0}, {}, Rounding::HalfDown}}), Likelihood(kind, 0.5), 1.0};
}

MarkovModel fiveSlopes(Index cells)
{
    return {StateSpace({{"f", cells, false, -2, 5, {1.0 / 3.0, 1.0 / 3.0}, {}, Rounding::HalfDown}}),
            Likelihood(LikelihoodKind::Rice, 0.5), 1.0};
}

std::vector<float> exponentials(Random &random, Index count)
{
    std::vector<float> y(static_cast<std::size_t>(count));
    for (float &value : y)
        value = float(random.exponential());
    return y;
}

} // namespace

/// The sequential Markov detector against Lindley's closed form, and its regulation.
class tst_Smd : public QObject
{
    Q_OBJECT

private slots:
    void lindley()
    {
        // u = max(u + K, 0) + y on Exp(1): σ = e^{-d(1-σ)}, d = -K; P(max(u + K, 0) > T) = σ e^{-(1-σ)T}.
        const double lnK = -1.3;
        double sigma = 0.5;
        for (int i = 0; i < 200; ++i)
            sigma = std::exp(lnK * (1.0 - sigma));
        Smd detector(stable(4096), {ResetLaw::Fixed, lnK});
        Random random(3, 1);
        std::vector<float> statistic(4096);
        double continued = 0.0;
        double frames = 0.0;
        std::vector<double> above(3, 0.0);
        const std::vector<double> levels{2.0, 5.0, 8.0};
        for (int t = 0; t < 1200; ++t) {
            detector.update(exponentials(random, 4096), statistic);
            if (t < 200)
                continue;
            frames += 1.0;
            continued += detector.regulation().continuedFraction;
            for (float u : statistic)
                for (std::size_t i = 0; i < levels.size(); ++i)
                    above[i] += double(u) + lnK > levels[i] ? 1.0 : 0.0;
        }
        QVERIFY2(std::abs(continued / frames - sigma) < 0.002,
                 qPrintable(QString("%1, closed form %2").arg(continued / frames).arg(sigma)));
        for (std::size_t i = 0; i < levels.size(); ++i) {
            const double expected = sigma * std::exp(-(1.0 - sigma) * levels[i]);
            const double found = above[i] / (frames * 4096.0);
            // Excursions last some ten frames, so ten times the binomial variance.
            const double error = std::sqrt(10.0 * expected / (frames * 4096.0));
            QVERIFY2(std::abs(found - expected) < 5.0 * error,
                     qPrintable(QString("T %1: %2, closed form %3").arg(levels[i]).arg(found).arg(expected)));
        }
    }

    void meanLawBalances()
    {
        // Parsons' self-check: the mean of ln Λ over all states is the mean of y, every frame.
        Smd detector({StateSpace({{"r", 64, true, -3, 7, {1.0}, {}, Rounding::Trunc}}), Likelihood(), 1.0},
                     {ResetLaw::Mean});
        Random random(4, 1);
        std::vector<float> statistic(64);
        for (int t = 0; t < 60; ++t) {
            const std::vector<float> y = exponentials(random, 64);
            detector.update(y, statistic);
            double scores = 0.0;
            for (float score : detector.scores())
                scores += double(score) + detector.offset();
            double mean = 0.0;
            for (float value : y)
                mean += double(value);
            QVERIFY(std::abs(scores / double(detector.scores().size()) - mean / 64.0) < 1e-5);
        }
    }

    void halfLawSettles()
    {
        Smd detector(fiveSlopes(1000), {ResetLaw::Half, 0.0});
        Random random(6, 1);
        std::vector<float> statistic(1000);
        double continued = 0.0;
        for (int t = 0; t < 1000; ++t) {
            detector.update(exponentials(random, 1000), statistic);
            if (t >= 500)
                continued += detector.regulation().continuedFraction / 500.0;
        }
        QVERIFY2(std::abs(continued - 0.5) < 0.02, qPrintable(QString::number(continued)));
    }

    void meanLawOfAnInfiniteField()
    {
        // P(W > 0) = 0.5671, the omega constant, and K = -1.310, where paths meet fresh noise at every step.
        Smd detector(stable(40000), {ResetLaw::Mean});
        Random random(5, 1);
        std::vector<float> statistic(40000);
        double lnK = 0.0;
        double continued = 0.0;
        for (int t = 0; t < 160; ++t) {
            detector.update(exponentials(random, 40000), statistic);
            if (t < 60)
                continue;
            lnK += detector.regulation().lnK / 100.0;
            continued += detector.regulation().continuedFraction / 100.0;
        }
        QVERIFY2(std::abs(lnK + 1.310) < 0.004, qPrintable(QString::number(lnK)));
        QVERIFY2(std::abs(continued - 0.5671) < 0.003, qPrintable(QString::number(continued)));
    }

    void forgetting()
    {
        Smd detector(fiveSlopes(50), {ResetLaw::Fixed, 0.69});
        const Grid grid{{{"f", "Hz", 0.0, 1.0, 50, false}}};
        std::vector<float> y(50, 0.0f);
        y[20] = 40.0f;
        std::vector<float> statistic(50);
        detector.update(y, statistic);
        detector.update(y, statistic);
        QVERIFY(statistic[20] > 10.0f);
        detector.forget(grid, {{20}, {3}});
        for (Index plane = 0; plane < 5; ++plane)
            for (Index cell = 17; cell <= 23; ++cell)
                QVERIFY(detector.scores()[std::size_t(plane * 50 + cell)] <= 0.0f);
    }

    void resumesFromMemory()
    {
        Smd whole(fiveSlopes(100), {ResetLaw::Half, 0.5});
        Random random(7, 1);
        std::vector<float> statistic(100);
        std::vector<std::vector<float>> frames;
        for (int t = 0; t < 40; ++t)
            frames.push_back(exponentials(random, 100));
        for (int t = 0; t < 20; ++t)
            whole.update(frames[std::size_t(t)], statistic);
        Smd resumed(fiveSlopes(100), {ResetLaw::Half, 0.5});
        resumed.setState(*whole.state());
        std::vector<float> again(100);
        for (int t = 20; t < 40; ++t) {
            whole.update(frames[std::size_t(t)], statistic);
            resumed.update(frames[std::size_t(t)], again);
            QCOMPARE(again, statistic);
            QCOMPARE(resumed.regulation().lnK, whole.regulation().lnK);
        }
    }

    void firstFrameIsTheLikelihood()
    {
        Smd detector(stable(3, LikelihoodKind::Rice), {ResetLaw::Fixed, -0.08});
        std::vector<float> statistic(3);
        detector.update(std::vector<float>{0.0f, 1.0f, 10.0f}, statistic);
        // -r0 + ln I0(2√(r0 y)), r0 = 0.5; I0(√2) = 1.56608, I0(√20) = 17.4989
        QVERIFY(std::abs(statistic[0] + 0.5f) < 1e-6f);
        QVERIFY(std::abs(double(statistic[1]) - (-0.5 + std::log(1.5660829297563506))) < 1e-5);
        QVERIFY(std::abs(double(statistic[2]) - (-0.5 + std::log(std::cyl_bessel_i(0.0, std::sqrt(20.0))))) < 1e-5);
    }
};

FAINTLINE_TEST(tst_Smd)
#include "tst_Smd.moc"
