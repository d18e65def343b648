#include "signal/FrequencyCurve.h"
#include "support/test.h"

#include "support/errors.h"

#include <cmath>
#include <limits>

using namespace faintline;
using namespace faintline::test;

namespace {

/// Knots at 2, 2½ and 3 s.
FrequencyCurve bent()
{
    return {{"time", "s", 2.0, 0.5, 3, false}, {10.0, 20.0, -4.0}};
}

/// Midpoints of a million pieces: a kink within one of them costs less than 1e-9.
double integral(const FrequencyCurve &curve, double from, double to)
{
    constexpr int pieces = 1'000'000;
    const double width = (to - from) / pieces;
    double sum = 0.0;
    for (int i = 0; i < pieces; ++i)
        sum += curve.at(from + (i + 0.5) * width);
    return sum * width;
}

} // namespace

/// A frequency between its knots, and the turns that it makes: by hand and by numerical integration.
class tst_FrequencyCurve : public QObject
{
    Q_OBJECT

private slots:
    void isLinearBetweenKnots()
    {
        const FrequencyCurve curve = bent();
        QCOMPARE(curve.at(2.0), 10.0);
        QCOMPARE(curve.at(2.125), 12.5);
        QCOMPARE(curve.at(2.5), 20.0);
        QCOMPARE(curve.at(2.75), 8.0);
        QCOMPARE(curve.at(3.0), -4.0);
        QCOMPARE(curve.at(-1e9), 10.0);
        QCOMPARE(curve.at(1e9), -4.0);
        QVERIFY(std::abs(curve.meanHz() - 26.0 / 3.0) < 1e-12);
    }

    void turnsAreItsIntegral_data()
    {
        QTest::addColumn<double>("seconds");
        for (const double seconds : {-3.0, 1.9, 2.0, 2.2, 2.5, 2.9, 3.0, 7.5})
            QTest::addRow("%g s", seconds) << seconds;
    }

    void turnsAreItsIntegral()
    {
        QFETCH(double, seconds);
        const FrequencyCurve curve = bent();
        QVERIFY(std::abs(curve.cyclesAt(seconds) - integral(curve, 2.0, seconds)) < 1e-8);
    }

    void turnsHaveNoStepAtAKnot()
    {
        const FrequencyCurve curve = bent();
        for (const double knot : {2.0, 2.5, 3.0})
            QVERIFY(std::abs(curve.cyclesAt(knot + 1e-9) - curve.cyclesAt(knot - 1e-9)) < 1e-7);
    }

    void oneKnotIsAConstant()
    {
        const FrequencyCurve curve({"time", "s", 5.0, 1.0, 1, false}, {3.0});
        for (const double seconds : {0.0, 5.0, 5.5, 100.0}) {
            QCOMPARE(curve.at(seconds), 3.0);
            QCOMPARE(curve.cyclesAt(seconds), 3.0 * (seconds - 5.0));
        }
    }

    void refusals()
    {
        const auto refusal = [](Index count, std::vector<double> hz) {
            return errorOf([&] { FrequencyCurve({"time", "s", 0.0, 1.0, count, false}, std::move(hz)); });
        };
        const std::string lengths = "frequency curve: needs one frequency for each of at least one time";
        QCOMPARE(refusal(0, {}), lengths);
        QCOMPARE(refusal(3, {1.0, 2.0}), lengths);
        const std::string finite = "frequency curve: has a frequency that is not finite";
        QCOMPARE(refusal(2, {1.0, std::nan("")}), finite);
        QCOMPARE(refusal(2, {std::numeric_limits<double>::infinity(), 1.0}), finite);
        QCOMPARE(refusal(2, {1.0, 2.0}), std::string());
    }
};

FAINTLINE_TEST(tst_FrequencyCurve)
#include "tst_FrequencyCurve.moc"
