#include "base/Random.h"
#include "inspect/doppler/dopplerFit.h"
#include "support/errors.h"
#include "support/test.h"

#include <array>
#include <cmath>

using namespace faintline;
using namespace faintline::test;

namespace {

using Points = std::vector<DopplerPoint>;

/// Points of a pass without errors, evenly spaced.
Points pointsOf(const DopplerPass &pass, double c, double from, double to, int count, double deviationHz = 1.0)
{
    Points points;
    for (int i = 0; i < count; ++i) {
        const double t = from + (to - from) * i / (count - 1);
        points.push_back({t, receivedHz(pass, c, t), deviationHz});
    }
    return points;
}

/// Errors of variance 1 of a process with correlation φ from point to point; or the mean of `smoothing` neighbours
/// under half a sine, as long windows and smoothed paths have them.
std::vector<double> errorsOf(int count, double phi, int smoothing, std::uint64_t stream)
{
    std::vector<float> normals(std::size_t(count + smoothing + 1));
    Random(31, stream).normals(normals, 1.0f);
    std::vector<double> errors;
    double last = double(normals.back());
    for (int i = 0; i < count; ++i) {
        if (smoothing > 0) {
            double sum = 0.0;
            double squares = 0.0;
            for (int k = 0; k < smoothing; ++k) {
                const double weight = std::sin(std::numbers::pi * (k + 0.5) / smoothing);
                sum += weight * double(normals[std::size_t(i + k)]);
                squares += weight * weight;
            }
            errors.push_back(sum / std::sqrt(squares));
        } else {
            last = phi * last + std::sqrt(1.0 - phi * phi) * double(normals[std::size_t(i)]);
            errors.push_back(last);
        }
    }
    return errors;
}

void addErrors(Points &points, const std::vector<double> &errors)
{
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i].hz += errors[i] * points[i].deviationHz;
}

bool isNear(double value, double truth, double relative)
{
    return std::abs(value - truth) <= relative * std::abs(truth);
}

bool says(const DopplerFit &fit, const std::string &part)
{
    return std::any_of(fit.sentences.begin(), fit.sentences.end(),
                       [&](const std::string &sentence) { return contains(sentence, part); });
}

std::array<bool, 4> covered(const DopplerFit &fit, const DopplerPass &truth)
{
    return {fit.restHz.contains(truth.restHz), fit.metresPerSecond.contains(truth.metresPerSecond),
            fit.rangeMetres.contains(truth.rangeMetres), fit.closestSeconds.contains(truth.closestSeconds)};
}

/// Whatever is sent at τ arrives r(τ)/c later.
double arrival(const DopplerPass &pass, double c, double sent)
{
    return sent + std::hypot(pass.rangeMetres, pass.metresPerSecond * (sent - pass.closestSeconds)) / c;
}

/// When it was sent, by bisection.
double sentAt(const DopplerPass &pass, double c, double t)
{
    double low =
        t - 2.0 * (pass.rangeMetres + c * std::abs(t - pass.closestSeconds) + 1.0) / (c - pass.metresPerSecond);
    double high = t;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (arrival(pass, c, middle) < t ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// A pass drawn from a wide range, its track seen from before to after, with 0.5 to 10 % of the shift as errors.
struct Drawn {
    DopplerPass pass;
    Points points;
};

Drawn drawn(Random &random)
{
    const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
    Drawn one;
    const double c = propagation::air;
    one.pass = {50.0 * std::pow(20.0, random.uniform()), c * between(0.03, 0.5),
                50.0 * std::pow(20.0, random.uniform()), between(100.0, 120.0)};
    const double time = one.pass.rangeMetres / one.pass.metresPerSecond;
    const double heard = one.pass.closestSeconds + one.pass.rangeMetres / c;
    const double from = heard - time * between(2.0, 6.0);
    const double to = heard + time * between(2.0, 6.0);
    const int count = int(between(60.0, 200.0));
    const double deviation = one.pass.restHz * one.pass.metresPerSecond / c * std::pow(10.0, between(-2.3, -1.0));
    one.points = pointsOf(one.pass, c, from, to, count, deviation);
    return one;
}

} // namespace

/// The pass of a source: the model against bisection and differences of the phase, and the fit against simulated
/// passes.
///
/// The long lane takes 10 000 passes a row, and 88 to 92 % as limits.
class tst_dopplerFit : public QObject
{
    Q_OBJECT

private slots:
    void modelAgreesWithBisection_data()
    {
        QTest::addColumn<double>("c");
        QTest::addColumn<double>("v");
        QTest::addColumn<double>("R");
        QTest::addColumn<double>("tolerance"); // of the differences of the phase, relative to the shift
        QTest::newRow("car") << propagation::air << 30.0 << 20.0 << 1e-5;
        QTest::newRow("fast aircraft") << propagation::air << 300.0 << 800.0 << 1e-5;
        QTest::newRow("ship") << propagation::water << 8.0 << 500.0 << 1e-4;
        QTest::newRow("satellite") << propagation::light << 7500.0 << 5e5 << 1e-2;
    }

    void modelAgreesWithBisection()
    {
        QFETCH(double, c);
        QFETCH(double, v);
        QFETCH(double, R);
        QFETCH(double, tolerance);
        const DopplerPass pass{100.0, v, R, 3.0};
        const double time = R / v;
        for (double t = 3.0 - 10.0 * time; t <= 3.0 + 10.0 * time; t += 0.37 * time) {
            const double sent = sentAt(pass, c, t);
            QVERIFY2(std::abs(emissionSeconds(pass, c, t) - (sent - 3.0)) < 1e-9 * time + 1e-12,
                     qPrintable(QString::number(t)));
            const double step = 1e-4 * time;
            const double phases = pass.restHz * (sentAt(pass, c, t + step) - sentAt(pass, c, t - step)) / (2.0 * step);
            QVERIFY2(std::abs(receivedHz(pass, c, t) - phases) < tolerance * pass.restHz * v / c,
                     qPrintable(QString::number(receivedHz(pass, c, t) - phases)));
        }
    }

    void frequencyIsAtRestWhereTheClosestIsHeard()
    {
        const DopplerPass pass{440.0, 50.0, 100.0, 7.0};
        const double heard = 7.0 + 100.0 / propagation::air;
        QVERIFY(std::abs(receivedHz(pass, propagation::air, heard) - 440.0) < 1e-9);
        QVERIFY(receivedHz(pass, propagation::air, 7.0) > 440.0 + 1.0);
        QVERIFY(isNear(receivedHz(pass, propagation::air, -1e6), 440.0 / (1.0 - 50.0 / propagation::air), 1e-6));
        QVERIFY(isNear(receivedHz(pass, propagation::air, 1e6), 440.0 / (1.0 + 50.0 / propagation::air), 1e-6));
    }

    void recoversAPassWithoutErrors_data()
    {
        QTest::addColumn<double>("c");
        QTest::addColumn<double>("f0");
        QTest::addColumn<double>("v");
        QTest::addColumn<double>("R");
        QTest::newRow("car") << propagation::air << 90.0 << 25.0 << 15.0;
        QTest::newRow("fast aircraft") << propagation::air << 70.0 << 280.0 << 1500.0;
        QTest::newRow("ship") << propagation::water << 52.0 << 9.0 << 800.0;
        QTest::newRow("satellite") << propagation::light << 145.8e6 << 7500.0 << 600e3;
    }

    void recoversAPassWithoutErrors()
    {
        QFETCH(double, c);
        QFETCH(double, f0);
        QFETCH(double, v);
        QFETCH(double, R);
        const DopplerPass truth{f0, v, R, 1000.0};
        const double time = R / v;
        const DopplerFit fit =
            fitDopplerPass(pointsOf(truth, c, 1000.0 - 4.0 * time, 1000.0 + 5.0 * time, 120, 1e-2 * f0 * v / c), c);
        QVERIFY2(isNear(fit.pass.restHz, f0, 1e-5 * v / c), qPrintable(QString::number(fit.pass.restHz - f0)));
        QVERIFY2(isNear(fit.pass.metresPerSecond, v, 1e-4), qPrintable(QString::number(fit.pass.metresPerSecond)));
        QVERIFY2(isNear(fit.pass.rangeMetres, R, 1e-4), qPrintable(QString::number(fit.pass.rangeMetres)));
        QVERIFY(std::abs(fit.pass.closestSeconds - 1000.0) < 1e-4 * time);
        QVERIFY(isNear(fit.slopeHzPerSecond(), -f0 * v * v / (c * R), 1e-3));
        QVERIFY(std::abs(fit.heardSeconds() - 1000.0 - R / c) < 1e-4 * time);
        QVERIFY(fit.isDetermined());
        QVERIFY(says(fit, "which side"));
        QVERIFY(says(fit, "in proportion"));
        QCOMPARE(fit.sentences.size(), std::size_t(2));
    }

    void coverage_data()
    {
        QTest::addColumn<double>("phi");
        QTest::addColumn<int>("smoothing");
        QTest::addColumn<int>("passes");
        QTest::addColumn<double>("tolerance"); // of 90 %: three deviations of as many passes
        QTest::newRow("independent errors") << 0.0 << 0 << 1500 << 0.023;
        QTest::newRow("errors of correlation 0.5") << 0.5 << 0 << 300 << 0.052;
        QTest::newRow("smoothed errors") << 0.0 << 4 << 300 << 0.052;
    }

    void coverage()
    {
        QFETCH(double, phi);
        QFETCH(int, smoothing);
        QFETCH(int, passes);
        QFETCH(double, tolerance);
        if (test::isLong()) {
            passes = 10000; // 7 ms each
            tolerance = 0.02;
        }
        constexpr std::array names{"f0", "v", "R", "t0"};
        std::array<int, 4> counts{};
        Random random(77, std::uint64_t(smoothing));
        for (int i = 0; i < passes; ++i) {
            Drawn one = drawn(random);
            addErrors(one.points, errorsOf(int(one.points.size()), phi, smoothing, std::uint64_t(i)));
            const std::array<bool, 4> inside = covered(fitDopplerPass(one.points, propagation::air), one.pass);
            for (std::size_t k = 0; k < counts.size(); ++k)
                counts[k] += inside[k] ? 1 : 0;
        }
        for (std::size_t k = 0; k < counts.size(); ++k)
            qInfo("%s: %.2f %% of %d intervals", names[k], 100.0 * counts[k] / passes, passes);
        for (std::size_t k = 0; k < counts.size(); ++k)
            QVERIFY2(std::abs(double(counts[k]) / passes - 0.9) <= tolerance, names[k]);
    }

    void outliersAreLeftOut()
    {
        const DopplerPass truth{120.0, 40.0, 200.0, 30.0};
        Points points = pointsOf(truth, propagation::air, 5.0, 60.0, 140, 0.2);
        addErrors(points, errorsOf(140, 0.0, 0, 5));
        const DopplerFit before = fitDopplerPass(points, propagation::air);
        for (const std::size_t i : {10u, 11u, 12u, 60u, 61u, 90u, 131u})
            points[i].hz += i % 2 == 0 ? 6.0 : -9.0;
        const DopplerFit after = fitDopplerPass(points, propagation::air);
        for (const std::size_t i : {10u, 11u, 12u, 60u, 61u, 90u, 131u})
            QVERIFY(after.isLeftOut[i]);
        QVERIFY(std::count(after.isLeftOut.begin(), after.isLeftOut.end(), char(1)) <= 9);
        QVERIFY(says(after, "Points left out"));
        const double half = 0.5 * (*before.metresPerSecond.high - *before.metresPerSecond.low);
        QVERIFY(std::abs(after.pass.metresPerSecond - before.pass.metresPerSecond) < half);
        for (const bool inside : covered(after, truth))
            QVERIFY(inside);
        QVERIFY(isNear(after.rmsHz, 0.2, 0.3));
        QVERIFY(isNear(after.residualHz[131], -9.0, 0.1));
    }

    void passThatIsNotSeen_data()
    {
        QTest::addColumn<double>("from");
        QTest::addColumn<double>("to");
        QTest::addColumn<QString>("sentence");
        QTest::newRow("approach") << -60.0 << -7.0 << QStringLiteral("approaching");
        QTest::newRow("departure") << 8.0 << 60.0 << QStringLiteral("going away");
    }

    /// 30 m/s and 150 m: the frequency falls for 10 s, of which the first and the last are seen.
    void passThatIsNotSeen()
    {
        QFETCH(double, from);
        QFETCH(double, to);
        QFETCH(QString, sentence);
        const DopplerPass truth{100.0, 30.0, 150.0, 0.0};
        Points points = pointsOf(truth, propagation::air, from, to, 120, 0.2);
        addErrors(points, errorsOf(120, 0.0, 0, 9));
        const DopplerFit fit = fitDopplerPass(points, propagation::air);
        QVERIFY2(says(fit, "closest approach may lie outside the track"), fit.sentences.front().c_str());
        QVERIFY2(says(fit, sentence.toStdString()), fit.sentences.front().c_str());
        for (const bool inside : covered(fit, truth))
            QVERIFY(inside);
        QVERIFY(!fit.metresPerSecond.high || *fit.metresPerSecond.high > 60.0);
        QVERIFY(!fit.rangeMetres.high || *fit.rangeMetres.high > 300.0);
    }

    void constantFrequency()
    {
        Points points;
        for (int i = 0; i < 80; ++i)
            points.push_back({0.5 * i, 61.0, 0.05});
        addErrors(points, errorsOf(80, 0.0, 0, 11));
        const DopplerFit fit = fitDopplerPass(points, propagation::water);
        QVERIFY(!fit.metresPerSecond.low);
        QVERIFY(!fit.rangeMetres.low && !fit.rangeMetres.high);
        QVERIFY(!fit.isDetermined());
        QVERIFY2(says(fit, "No Doppler shift"), fit.sentences.front().c_str());
    }

    /// Only the middle of a pass: the fall is straight.
    void straightFall()
    {
        const DopplerPass truth{100.0, 20.0, 400.0, 0.0};
        Points points = pointsOf(truth, propagation::air, -2.0, 4.0, 100, 0.05);
        addErrors(points, errorsOf(100, 0.0, 0, 12));
        const DopplerFit fit = fitDopplerPass(points, propagation::air);
        QVERIFY(!fit.metresPerSecond.high || *fit.metresPerSecond.high > 80.0);
        QVERIFY2(says(fit, "only v²/R, about 0.9") || says(fit, "only v²/R, about 1.0"), fit.sentences[0].c_str());
        for (const bool inside : covered(fit, truth))
            QVERIFY(inside);
    }

    /// Passed between two points: how near it was cannot be told.
    void suddenPass()
    {
        const DopplerPass truth{100.0, 20.0, 0.5, 0.26};
        Points points = pointsOf(truth, propagation::air, -40.0, 40.0, 81, 0.3);
        addErrors(points, errorsOf(81, 0.0, 0, 13));
        const DopplerFit fit = fitDopplerPass(points, propagation::air);
        QVERIFY(!fit.rangeMetres.low);
        QVERIFY(fit.rangeMetres.high && *fit.rangeMetres.high < 40.0);
        QVERIFY2(says(fit, "no lower limit"), fit.sentences.front().c_str());
        for (const bool inside : covered(fit, truth))
            QVERIFY(inside);
    }

    void risingFrequency()
    {
        Points points;
        for (int i = 0; i < 80; ++i)
            points.push_back({0.5 * i, 61.0 + 0.1 * i, 0.05});
        addErrors(points, errorsOf(80, 0.0, 0, 14));
        const DopplerFit fit = fitDopplerPass(points, propagation::water);
        QVERIFY2(contains(fit.sentences.front(), "The frequency rises"), fit.sentences.front().c_str());
        QVERIFY(!fit.isDetermined());
    }

    void refusals()
    {
        const DopplerPass pass{100.0, 30.0, 150.0, 0.0};
        const Points good = pointsOf(pass, propagation::air, -20.0, 20.0, 20, 0.1);
        const auto refused = [](Points points, double c, const char *part) {
            const std::string error = errorOf([&] { fitDopplerPass(points, c); });
            return contains(error, part) && !contains(error, "\n");
        };
        QVERIFY(refused(good, 0.0, "must be above 0 m/s"));
        QVERIFY(refused(good, NAN, "must be above 0 m/s"));
        QVERIFY(refused({good.begin(), good.begin() + 7}, 343.0, "at least 8 points; this track has 7"));
        Points bad = good;
        bad[3].hz = INFINITY;
        QVERIFY(refused(bad, 343.0, "point 4: is not finite"));
        bad = good;
        bad[3].hz = -5.0;
        QVERIFY(refused(bad, 343.0, "absolute frequencies"));
        bad = good;
        bad[3].deviationHz = 0.0;
        QVERIFY(refused(bad, 343.0, "standard deviation above 0"));
        bad = good;
        bad[3].seconds = bad[2].seconds;
        QVERIFY(refused(bad, 343.0, "later than the one before"));
    }
};

FAINTLINE_TEST(tst_dopplerFit)
#include "tst_dopplerFit.moc"
