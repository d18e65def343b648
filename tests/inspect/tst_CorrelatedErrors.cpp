#include "base/Random.h"
#include "inspect/doppler/DopplerProblem.h"
#include "support/test.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace faintline;

/// Whitening against the matrix of correlations itself, and the estimate against simulated errors.
class tst_CorrelatedErrors : public QObject
{
    Q_OBJECT

private slots:
    /// P = (WᵀW)⁻¹ is a matrix of correlations, the same along each diagonal, in blocks.
    void whitening()
    {
        constexpr Eigen::Index n = 9;
        std::vector<char> isFirst(n, 0);
        isFirst[5] = 1;
        const CorrelatedErrors errors(isFirst, {0.6, -0.3, 0.2});
        Eigen::MatrixXd W = Eigen::MatrixXd::Identity(n, n);
        for (Eigen::Index i = 0; i < n; ++i)
            errors.whiten(W.col(i));
        const Eigen::MatrixXd P = (W.transpose() * W).inverse();
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index j = 0; j < n; ++j) {
                const bool isTogether = (i < 5) == (j < 5);
                const double wanted = isTogether ? P(0, std::abs(i - j)) : 0.0;
                QVERIFY(std::abs(P(i, j) - wanted) < 1e-9);
            }
        QVERIFY(std::abs(P(0, 0) - 1.0) < 1e-12);
        QVERIFY(std::abs(P(0, 1) - 0.6) < 1e-12);
        QVERIFY(std::abs(errors.logDeterminant() - std::log(P.determinant())) < 1e-9);
        QVERIFY(std::abs(errors.effectiveCount() - P.inverse().sum()) < 1e-9);
        QCOMPARE(CorrelatedErrors(isFirst, {}).effectiveCount(), 9.0);
    }

    void estimate_data()
    {
        QTest::addColumn<double>("phi");
        QTest::newRow("none") << 0.0;
        QTest::newRow("some") << 0.5;
        QTest::newRow("much") << 0.8;
    }

    /// Of errors with correlation φ from one to the next n_eff is n(1 - φ)/(1 + φ), also where a fit has taken a mean and a
    /// slope out of them.
    void estimate()
    {
        QFETCH(double, phi);
        constexpr Eigen::Index n = 150;
        constexpr int runs = 40;
        Eigen::MatrixXd J(n, 2);
        J.col(0).setOnes();
        J.col(1) = Eigen::VectorXd::LinSpaced(n, -1.0, 1.0);
        std::vector<double> ratios;
        for (int run = 0; run < runs; ++run) {
            Random random(4, std::uint64_t(run));
            Eigen::VectorXd errors(n);
            for (Eigen::Index i = 0; i < n; ++i)
                errors[i] =
                    i == 0 ? random.normal() : phi * errors[i - 1] + std::sqrt(1.0 - phi * phi) * random.normal();
            const Eigen::VectorXd residuals = errors - J * J.colPivHouseholderQr().solve(errors);
            const double found = likeliestErrors(residuals, J, std::vector<char>(n, 0)).effectiveCount();
            ratios.push_back(found / (n * (1.0 - phi) / (1.0 + phi)));
        }
        std::sort(ratios.begin(), ratios.end());
        QVERIFY2(ratios[runs / 2] > 0.85 && ratios[runs / 2] < 1.2, qPrintable(QString::number(ratios[runs / 2])));
    }
};

FAINTLINE_TEST(tst_CorrelatedErrors)
#include "tst_CorrelatedErrors.moc"
