#include "inspect/doppler/DopplerProblem.h"
#include "support/test.h"

#include "base/Random.h"

#include <cmath>

using namespace faintline;

namespace {

const DopplerPass car{440.0, 25.0, 12.0, 6.0};
const DopplerPass ship{80.0, 9.0, 600.0, 150.0};
const DopplerPass satellite{437.5e6, 7500.0, 700e3, 300.0};

struct Case {
    const char *name;
    DopplerPass pass;
    double propagation;
    double span;
};
const Case cases[]{{"car", car, propagation::air, 12.0},
                   {"ship", ship, propagation::water, 300.0},
                   {"satellite", satellite, propagation::light, 600.0}};

std::vector<DopplerPoint> pointsOf(const Case &of, int count = 60)
{
    std::vector<DopplerPoint> points;
    for (int i = 0; i < count; ++i) {
        const double t = of.span * i / (count - 1);
        points.push_back({t, receivedHz(of.pass, of.propagation, t), 0.1 + 0.001 * i});
    }
    return points;
}

void addCases()
{
    QTest::addColumn<int>("which");
    for (int i = 0; i < 3; ++i)
        QTest::newRow(cases[i].name) << i;
}

bool isNear(double a, double b, double relative)
{
    return std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b));
}

} // namespace

/// The least-squares problem of a Doppler pass: coordinates, derivatives against differences, minima against a known
/// pass and against a search of its own.
class tst_DopplerProblem : public QObject
{
    Q_OBJECT

private slots:
    void coordinatesAndPassesAreTheSame_data() { addCases(); }

    void coordinatesAndPassesAreTheSame()
    {
        QFETCH(int, which);
        const Case &of = cases[which];
        const DopplerProblem problem(pointsOf(of), of.propagation);
        QCOMPARE(problem.count(), std::size_t(60));
        const DopplerCoordinates x = problem.coordinatesOf(of.pass);
        const DopplerPass again = problem.passOf(x);
        QVERIFY(isNear(again.restHz, of.pass.restHz, 1e-12));
        QVERIFY(isNear(again.metresPerSecond, of.pass.metresPerSecond, 1e-9));
        QVERIFY(isNear(again.rangeMetres, of.pass.rangeMetres, 1e-9));
        QVERIFY(std::abs(again.closestSeconds - of.pass.closestSeconds) < 1e-9 * of.span);
        // By the definitions of x1 and x2: β/(1 - β) and R/v.
        const double beta = of.pass.metresPerSecond / of.propagation;
        QVERIFY(isNear(std::exp(x[1]), beta / (1.0 - beta), 1e-9));
        const double perSecond = std::exp(x[2]) / (of.pass.rangeMetres / of.pass.metresPerSecond);
        const DopplerPass twice{of.pass.restHz, of.pass.metresPerSecond, 2.0 * of.pass.rangeMetres,
                                of.pass.closestSeconds};
        QVERIFY(isNear(std::exp(problem.coordinatesOf(twice)[2]),
                       perSecond * 2.0 * of.pass.rangeMetres / of.pass.metresPerSecond, 1e-9));
        using P = DopplerParameter;
        QVERIFY(isNear(problem.valueOf(P::RestHz, problem.ownCoordinate(P::RestHz, x)), of.pass.restHz, 1e-12));
        QVERIFY(isNear(problem.valueOf(P::Speed, problem.ownCoordinate(P::Speed, x)), of.pass.metresPerSecond, 1e-9));
        QVERIFY(isNear(problem.valueOf(P::Range, problem.ownCoordinate(P::Range, x)), of.pass.rangeMetres, 1e-9));
        QVERIFY(std::abs(problem.valueOf(P::Closest, problem.ownCoordinate(P::Closest, x)) - of.pass.closestSeconds)
                < 1e-9 * of.span);
        QVERIFY(std::abs(problem.coordinateOfRest(of.pass.restHz) - x[0]) < 1e-12 * std::max(1.0, std::abs(x[0])));
    }

    void derivativesAreDifferences_data() { addCases(); }

    void derivativesAreDifferences()
    {
        QFETCH(int, which);
        const DopplerProblem problem(pointsOf(cases[which]), cases[which].propagation);
        const DopplerCoordinates x =
            problem.coordinatesOf(cases[which].pass) + DopplerCoordinates(0.1, -0.2, 0.3, 0.05);
        Eigen::MatrixXd derivatives;
        problem.residuals(x, &derivatives);
        QCOMPARE(derivatives.rows(), Eigen::Index(60));
        for (int i = 0; i < 4; ++i) {
            constexpr double step = 1e-5;
            const DopplerCoordinates by = step * DopplerCoordinates::Unit(i);
            const Eigen::VectorXd difference = (problem.residuals(x + by) - problem.residuals(x - by)) / (2.0 * step);
            const double error = (difference - derivatives.col(i)).norm();
            QVERIFY2(error < 1e-5 * derivatives.col(i).norm() + 1e-6,
                     qPrintable(QStringLiteral("x%1: %2 of %3").arg(i).arg(error).arg(derivatives.col(i).norm())));
        }
    }

    void withoutNoiseTheCostIsZero()
    {
        for (const Case &of : cases) {
            const DopplerProblem problem(pointsOf(of), of.propagation);
            const DopplerCoordinates x = problem.coordinatesOf(of.pass);
            QVERIFY2(problem.cost(x) < 1e-6, of.name); // of 60 points, each in standard deviations
            QVERIFY2(problem.cost(x + DopplerCoordinates(0.0, 0.1, 0.0, 0.0)) > 1.0, of.name);
        }
    }

    void theMinimumIsThePass()
    {
        for (const Case &of : cases) {
            const DopplerProblem problem(pointsOf(of), of.propagation);
            const DopplerCoordinates truth = problem.coordinatesOf(of.pass);
            const DopplerCoordinates found = problem.minimum(truth + DopplerCoordinates(0.02, 0.1, -0.1, 0.01));
            QVERIFY2((found - truth).norm() < 1e-3, of.name);
        }
    }

    void profilesHoldTheirParameter()
    {
        const Case &of = cases[0];
        const DopplerProblem problem(pointsOf(of), of.propagation);
        const DopplerCoordinates truth = problem.coordinatesOf(of.pass);
        for (const auto held :
             {DopplerParameter::RestHz, DopplerParameter::Speed, DopplerParameter::Range, DopplerParameter::Closest}) {
            const double own = problem.ownCoordinate(held, truth) + 0.02;
            const DopplerCoordinates found = problem.minimum(truth, held, own);
            QVERIFY(std::abs(problem.ownCoordinate(held, found) - own) < 1e-9);
            // No neighbour with the same value costs less: small steps of the other coordinates.
            const double least = problem.cost(found);
            QVERIFY(least > 0.0);
            for (int i = 0; i < 4; ++i)
                for (const double step : {-1e-3, 1e-3}) {
                    DopplerCoordinates other = found + step * DopplerCoordinates::Unit(i);
                    if (held == DopplerParameter::Range || held == DopplerParameter::Closest)
                        continue; // their own coordinate depends on several of these
                    if (i == int(held))
                        continue;
                    QVERIFY(problem.cost(other) >= least * (1.0 - 1e-9));
                }
        }
    }

    void aStraightLineIsRegression()
    {
        Random random(31, 1);
        std::vector<DopplerPoint> points;
        for (int i = 0; i < 40; ++i)
            points.push_back(
                {double(i) + random.uniform(), 100.0 - 0.3 * i + random.uniform(), 0.5 + random.uniform()});
        // Weighted regression by its normal equations, w = 1/σ².
        double w = 0, wt = 0, wf = 0, wtt = 0, wtf = 0;
        for (const DopplerPoint &p : points) {
            const double weight = 1.0 / (p.deviationHz * p.deviationHz);
            w += weight;
            wt += weight * p.seconds;
            wf += weight * p.hz;
            wtt += weight * p.seconds * p.seconds;
            wtf += weight * p.seconds * p.hz;
        }
        const double b = (w * wtf - wt * wf) / (w * wtt - wt * wt), a = (wf - b * wt) / w;
        double cost = 0.0;
        for (const DopplerPoint &p : points)
            cost += std::pow((p.hz - a - b * p.seconds) / p.deviationHz, 2);
        QVERIFY(isNear(DopplerProblem(points, propagation::air).straightLineCost(), cost, 1e-9));
    }

    void aCommonFactorOfTheErrorsIsOneOfTheCost()
    {
        std::vector<DopplerPoint> points = pointsOf(cases[1]);
        const DopplerProblem problem(points, propagation::water);
        const DopplerCoordinates x = problem.coordinatesOf(ship) + DopplerCoordinates(0.05, 0.0, 0.1, 0.0);
        for (DopplerPoint &point : points)
            point.deviationHz *= 3.0;
        const DopplerProblem coarser = problem.with(points);
        QVERIFY(isNear(coarser.cost(x) * 9.0, problem.cost(x), 1e-9));
    }
};

FAINTLINE_TEST(tst_DopplerProblem)
#include "tst_DopplerProblem.moc"
