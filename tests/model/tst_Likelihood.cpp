#include "model/Likelihood.h"
#include "support/test.h"

#include "base/Error.h"

#include <boost/math/special_functions/bessel.hpp>

#include <cmath>
#include <limits>

using namespace faintline;

namespace {

/// I0 overflows beyond 700: e^{-x} I0(x) from its asymptotic series there, to a part in 10¹⁰.
double lnI0(double x)
{
    return x < 600.0 ? std::log(boost::math::cyl_bessel_i(0, x))
                     : x - 0.5 * std::log(2.0 * M_PI * x) + std::log1p(1.0 / (8.0 * x) + 9.0 / (128.0 * x * x));
}

} // namespace

/// Log-likelihood ratios against Boost's Bessel function and the plain formulas.
class tst_Likelihood : public QObject
{
    Q_OBJECT

private slots:
    void rice_data()
    {
        QTest::addColumn<double>("snr");
        for (double snr : {0.05, 0.5, 1.0, 2.0, 10.0, 300.0})
            QTest::newRow(qPrintable(QString::number(snr))) << snr;
    }

    void rice()
    {
        QFETCH(double, snr);
        const Likelihood likelihood(LikelihoodKind::Rice, snr);
        std::vector<float> y{0.0f};
        for (double value = 1e-6; value <= 1e4; value *= 1.003)
            y.push_back(float(value));
        std::vector<float> lambda(y.size());
        likelihood.apply(y, lambda);
        double worst = 0.0;
        for (std::size_t i = 0; i < y.size(); ++i) {
            const double expected = -snr + lnI0(2.0 * std::sqrt(snr * double(y[i])));
            worst = std::max(worst, std::abs(double(lambda[i]) - expected) / std::max(1.0, std::abs(expected)));
            QVERIFY(std::abs(likelihood.at(double(y[i])) - expected) < 1e-9 * std::max(1.0, std::abs(expected)));
        }
        QVERIFY2(worst < 1e-6, qPrintable(QString::number(worst)));
    }

    void affine()
    {
        const Likelihood exponential(LikelihoodKind::Exponential, 3.0);
        const Likelihood linear(LikelihoodKind::Linear);
        const std::vector<float> y{0.0f, 1.0f, 4.0f};
        std::vector<float> lambda(3);
        exponential.apply(y, lambda);
        for (std::size_t i = 0; i < 3; ++i) // ln of the two densities' ratio
            QVERIFY(
                std::abs(double(lambda[i]) - std::log(0.25 * std::exp(-double(y[i]) / 4.0) / std::exp(-double(y[i]))))
                < 1e-6);
        linear.apply(y, lambda);
        QCOMPARE(lambda, y);
    }

    void swerling4_data()
    {
        QTest::addColumn<double>("snr");
        for (double snr : {0.05, 0.5, 2.0, 10.0, 300.0})
            QTest::newRow(qPrintable(QString::number(snr))) << snr;
    }

    // Against the mean of the constant amplitude's likelihood ratio over a power of density 4g·e^(-2g), by Simpson's rule.
    void swerling4()
    {
        QFETCH(double, snr);
        const Likelihood likelihood(LikelihoodKind::Swerling4, snr);
        std::vector<float> y;
        for (double value = 0.0; value < 60.0; value = 1.3 * value + 0.01)
            y.push_back(float(value));
        std::vector<float> lambda(y.size());
        likelihood.apply(y, lambda);
        for (std::size_t i = 0; i < y.size(); ++i) {
            constexpr int intervals = 4000;
            constexpr double step = 6.0 / intervals; // over the amplitude √g
            double sum = 0.0;
            for (int k = 0; k <= intervals; ++k) {
                const double amplitude = k * step;
                const double g = amplitude * amplitude;
                const double ratio = std::exp(-g * snr + lnI0(2.0 * std::sqrt(g * snr * double(y[i]))));
                const double weight = k == 0 || k == intervals ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
                sum += weight * 2.0 * amplitude * 4.0 * g * std::exp(-2.0 * g) * ratio;
            }
            const double expected = std::log(sum * step / 3.0);
            QVERIFY2(
                std::abs(likelihood.at(double(y[i])) - expected) < 1e-8 * std::max(1.0, std::abs(expected)),
                qPrintable(QString("y %1: %2, expected %3").arg(y[i]).arg(likelihood.at(double(y[i]))).arg(expected)));
            QVERIFY(std::abs(double(lambda[i]) - expected) < 2e-6 * std::max(1.0, std::abs(expected)));
        }
    }

    void badValuesAreNoEvidence()
    {
        constexpr float nan = std::numeric_limits<float>::quiet_NaN();
        constexpr float infinity = std::numeric_limits<float>::infinity();
        const std::vector<float> y{-1.0f, -infinity, infinity, 1e30f, nan, 1.0f};
        for (LikelihoodKind kind :
             {LikelihoodKind::Rice, LikelihoodKind::Exponential, LikelihoodKind::Linear, LikelihoodKind::Swerling4}) {
            const Likelihood likelihood(kind, 0.5);
            std::vector<float> lambda(y.size());
            likelihood.apply(y, lambda);
            for (std::size_t i = 0; i < 3; ++i)
                QCOMPARE(lambda[i], float(likelihood.at(0.0)));
            QVERIFY(std::isfinite(lambda[3]) && lambda[3] > 1e10f);
            QCOMPARE(lambda[4], 0.0f); // not observed: for neither hypothesis
            QCOMPARE(likelihood.at(double(nan)), 0.0);
            QVERIFY(std::abs(double(lambda[5]) - likelihood.at(1.0)) < 1e-6);
        }
    }

    void givenEvidenceStaysAsItIs()
    {
        const Likelihood likelihood(LikelihoodKind::Given);
        const std::vector<float> y{-3.5f, 0.0f, 2.0f, std::numeric_limits<float>::quiet_NaN()};
        std::vector<float> lambda(y.size());
        likelihood.apply(y, lambda);
        QCOMPARE(lambda, (std::vector<float>{-3.5f, 0.0f, 2.0f, 0.0f}));
        QCOMPARE(likelihood.at(-3.5), -3.5);
    }

    void refusals()
    {
        QVERIFY_EXCEPTION_THROWN(Likelihood(LikelihoodKind::Rice, 0.0), Error);
        QVERIFY_EXCEPTION_THROWN(Likelihood(LikelihoodKind::Exponential, -1.0), Error);
        QVERIFY_EXCEPTION_THROWN(Likelihood(LikelihoodKind::Rice, std::nan("")), Error);
        QVERIFY_EXCEPTION_THROWN(Likelihood(LikelihoodKind::Swerling4, 0.0), Error);
    }
};

FAINTLINE_TEST(tst_Likelihood)
#include "tst_Likelihood.moc"
