#include "base/Random.h"
#include "refine/PolynomialFit.h"
#include "support/test.h"

#include <cmath>
#include <vector>

using namespace faintline;

namespace {

constexpr double deviation = 0.3;

std::vector<SmoothedPoint> along(double curvature, double slope, double offset, int count, Random *noise = nullptr)
{
    std::vector<SmoothedPoint> points;
    for (int i = 0; i < count; ++i)
        points.push_back({curvature * i * i + slope * i + offset + (noise ? deviation * noise->normal() : 0.0)});
    return points;
}

} // namespace

/// Polynomials through positions.
class tst_PolynomialFit : public QObject
{
    Q_OBJECT

private slots:
    void followsWhatIsExact();
    void aStraightLineUnlessCurved();
    void variancesAreThoseOfManyFits();
    void twoPointsHaveNoSlope();
};

void tst_PolynomialFit::followsWhatIsExact()
{
    const PolynomialFit fit(along(0.01, -0.2, 7.0, 40), 100, 1e-3);
    QVERIFY(fit.isCurved());
    QVERIFY(std::abs(fit.positionAt(160.0) - (0.01 * 3600.0 - 0.2 * 60.0 + 7.0)) < 1e-9);
    QVERIFY(std::abs(fit.slopeAt(160.0) - (0.02 * 60.0 - 0.2)) < 1e-9);
}

void tst_PolynomialFit::aStraightLineUnlessCurved()
{
    int curved = 0;
    for (int trial = 0; trial < 500; ++trial) {
        Random random(8, std::uint64_t(trial));
        curved += PolynomialFit(along(0.0, 0.1, 0.0, 50, &random), 0, 0.0).isCurved() ? 1 : 0;
    }
    QVERIFY2(curved <= 3, qPrintable(QString::number(curved))); // errors are taken as 2.4 times as large
}

// The variance that is stated, without the factor for correlated frames, and without curvature.
void tst_PolynomialFit::variancesAreThoseOfManyFits()
{
    constexpr int trials = 4000;
    constexpr double frame = 45.0; // beyond the end
    double position = 0.0;
    double slope = 0.0;
    double stated = 0.0;
    double statedSlope = 0.0;
    for (int trial = 0; trial < trials; ++trial) {
        Random random(9, std::uint64_t(trial));
        const PolynomialFit fit(along(0.0, 0.1, 3.0, 30, &random), 0, 0.0);
        position += std::pow(fit.positionAt(frame) - (0.1 * frame + 3.0), 2) / trials;
        slope += std::pow(fit.slopeAt(frame) - 0.1, 2) / trials;
        stated += fit.positionVarianceAt(frame) / trials;
        statedSlope += fit.slopeVarianceAt(frame) / trials;
    }
    QVERIFY2(std::abs(stated / position / 6.0 - 1.0) < 0.1, qPrintable(QString::number(stated / position)));
    QVERIFY2(std::abs(statedSlope / slope / 6.0 - 1.0) < 0.1, qPrintable(QString::number(statedSlope / slope)));
}

void tst_PolynomialFit::twoPointsHaveNoSlope()
{
    const PolynomialFit fit(along(0.0, 5.0, 0.0, 2), 0, 0.1);
    QVERIFY(std::isinf(fit.slopeVarianceAt(10.0)));
    QVERIFY(std::isinf(fit.positionVarianceAt(10.0)));
    QCOMPARE(PolynomialFit(along(0.0, 0.0, 4.0, 1), 0, 0.1).positionAt(0.0), 4.0);
}

FAINTLINE_TEST(tst_PolynomialFit)
#include "tst_PolynomialFit.moc"
