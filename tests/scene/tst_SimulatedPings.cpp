#include "scene/SimulatedPings.h"
#include "support/frames.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;
using namespace faintline::test;

namespace {

PingScene scene(int pings = 20, int looks = 1)
{
    return {.pings = pings, .rangeCells = 200, .beams = 10, .looks = looks, .seed = 3};
}

struct Moments {
    double mean = 0.0;
    double variance = 0.0;
};

Moments momentsOf(const std::vector<float> &values)
{
    Moments m;
    for (float value : values)
        m.mean += double(value) / double(values.size());
    for (float value : values)
        m.variance += (double(value) - m.mean) * (double(value) - m.mean) / double(values.size());
    return m;
}

/// y in the cell of a target that stands still.
std::vector<float> targetCell(Echo echo, double snrDb, int pings, int looks = 1,
                              Fluctuation fluctuation = Fluctuation::None, int seed = 3)
{
    PingScene made = scene(pings, looks);
    made.rangeCells = 20;
    made.seed = seed;
    PingTarget target{.snrDb = snrDb, .echo = echo, .fluctuation = fluctuation, .rangeMetres = 3050.0};
    made.targets = {target};
    const SimulatedPings simulated(made);
    const std::vector<float> y = allOf(simulated);
    std::vector<float> values;
    for (int ping = 0; ping < pings; ++ping)
        values.push_back(y[std::size_t(ping * simulated.grid().size() + 5 * 10)]);
    return values;
}

/// Power that a target of 20 dB adds to its cell in each ping, over its mean.
std::vector<double> addedPowers(Fluctuation fluctuation, int pings, int seed)
{
    const std::vector<float> with = targetCell(Echo::Constant, 20.0, pings, 1, fluctuation, seed);
    const std::vector<float> without = targetCell(Echo::Constant, -60.0, pings, 1, Fluctuation::None, seed);
    std::vector<double> powers;
    for (std::size_t i = 0; i < with.size(); ++i)
        powers.push_back(0.01 * double(with[i] - without[i]));
    return powers;
}

/// Mean 1 and the variance of χ² with 2 or 4 degrees of freedom over 2 or 4.
void verifyLaw(const std::vector<double> &powers, double variance)
{
    const Moments m = momentsOf(std::vector<float>(powers.begin(), powers.end()));
    const double n = double(powers.size());
    QVERIFY2(std::abs(m.mean - 1.0) < 4.5 * std::sqrt(variance / n), qPrintable(QString::number(m.mean)));
    QVERIFY2(std::abs(m.variance - variance) < 4.5 * variance * std::sqrt(8.0 / n),
             qPrintable(QString::number(m.variance)));
}

} // namespace

/// Simulated pings: the laws of noise and echoes, random access, reverberation taken out.
class tst_SimulatedPings : public QObject
{
    Q_OBJECT

private slots:
    void noiseIsExponential()
    {
        const std::vector<float> y = allOf(SimulatedPings(scene(100))); // 200 000 cells
        const double n = double(y.size());
        const Moments m = momentsOf(y);
        QVERIFY2(std::abs(m.mean - 1.0) < 4.5 / std::sqrt(n), qPrintable(QString::number(m.mean)));
        QVERIFY2(std::abs(m.variance - 1.0) < 4.5 * std::sqrt(8.0 / n),
                 qPrintable(QString::number(m.variance))); // var of Exp's variance: 8
        for (double level : {0.5, 2.0, 5.0}) {
            const auto above = std::count_if(y.begin(), y.end(), [level](float v) { return double(v) > level; });
            const double p = std::exp(-level);
            QVERIFY(std::abs(double(above) / n - p) < 4.5 * std::sqrt(p * (1.0 - p) / n));
        }
    }

    void looksAverage()
    {
        const std::vector<float> y = allOf(SimulatedPings(scene(40, 5))); // χ² with 10 degrees of freedom, mean 1
        const double n = double(y.size());
        const Moments m = momentsOf(y);
        QVERIFY(std::abs(m.mean - 1.0) < 4.5 * std::sqrt(0.2 / n));
        QVERIFY(std::abs(m.variance - 0.2)
                < 4.5 * std::sqrt((2.0 * 0.04 + 6.0 * 0.008) / n)); // gamma of shape 5: κ₄ + 2κ₂²
    }

    void anyPingAlone()
    {
        PingScene made = scene();
        PingTarget target{.rangeMetres = 4000.0, .legs = {{0, 0.0, 0.0, 2.0, 1.0, 1}}};
        made.targets = {target};
        made.reverberation = Reverberation{20.0, 3.0, PingNormalisation::Estimated};
        const SimulatedPings pings(made);
        const std::vector<float> all = allOf(pings);
        const auto cells = std::size_t(pings.grid().size());
        for (Index ping : {Index(13), Index(2), Index(19)}) {
            std::vector<float> one(cells);
            SimulatedPings(made).read(ping, 1, one);
            QVERIFY(std::equal(one.begin(), one.end(), all.begin() + ping * Index(cells)));
        }
    }

    void theSeedNamesTheNoise()
    {
        PingScene other = scene();
        other.seed = 4;
        QVERIFY(allOf(SimulatedPings(scene())) == allOf(SimulatedPings(scene())));
        QVERIFY(allOf(SimulatedPings(scene())) != allOf(SimulatedPings(other)));
    }

    void echoes_data()
    {
        QTest::addColumn<int>("echo");
        QTest::addColumn<int>("looks");
        QTest::addColumn<double>("variance"); // at S = 5
        QTest::newRow("constant power") << int(Echo::Constant) << 1 << 1.0;
        QTest::newRow("fluctuating") << int(Echo::Fluctuating) << 1 << 36.0;
        QTest::newRow("constant amplitude") << int(Echo::Complex) << 1 << 11.0; // 1 + 2S
        QTest::newRow("constant power, four looks") << int(Echo::Constant) << 4 << 0.25;
        QTest::newRow("fluctuating, four looks") << int(Echo::Fluctuating) << 4 << 9.0;
        QTest::newRow("constant amplitude, four looks") << int(Echo::Complex) << 4 << 2.75;
    }

    void echoes()
    {
        QFETCH(int, echo);
        QFETCH(int, looks);
        QFETCH(double, variance);
        const int pings = 4000;
        const Moments m = momentsOf(targetCell(static_cast<Echo>(echo), 10.0 * std::log10(5.0), pings, looks));
        QVERIFY2(std::abs(m.mean - 6.0) < 4.5 * std::sqrt(variance / pings), qPrintable(QString::number(m.mean)));
        // The variance's own scatter is at most that of an exponential.
        QVERIFY2(std::abs(m.variance - variance) < 4.5 * variance * std::sqrt(8.0 / pings),
                 qPrintable(QString::number(m.variance)));
    }

    void constantPowerIsAdded()
    {
        const std::vector<float> with = targetCell(Echo::Constant, 7.0, 30);
        const std::vector<float> without = targetCell(Echo::Constant, -60.0, 30);
        for (std::size_t i = 0; i < with.size(); ++i)
            QVERIFY(std::abs(with[i] - without[i] - 5.01187f) < 1e-4f);
    }

    void twoTargetsInACell()
    {
        PingScene made = scene(1);
        PingTarget target{.snrDb = 10.0, .rangeMetres = 4000.0};
        const SimulatedPings none(made);
        made.targets = {target, target};
        const SimulatedPings two(made);
        const auto cell = std::size_t(two.truth().targets[0].cellAt(0));
        QVERIFY(std::abs(allOf(two)[cell] - allOf(none)[cell] - 20.0f) < 1e-4f);
    }

    void onePowerForATrack_data()
    {
        QTest::addColumn<int>("fluctuation");
        QTest::addColumn<double>("variance");
        QTest::newRow("Swerling 1") << int(Fluctuation::Swerling1) << 1.0;
        QTest::newRow("Swerling 3") << int(Fluctuation::Swerling3) << 0.5;
    }

    void onePowerForATrack()
    {
        QFETCH(int, fluctuation);
        QFETCH(double, variance);
        std::vector<double> powers;
        for (int seed = 0; seed < 1000; ++seed) {
            const std::vector<double> track = addedPowers(static_cast<Fluctuation>(fluctuation), 5, seed);
            for (const double power : track)
                QVERIFY(std::abs(power - track.front()) < 1e-5);
            powers.push_back(track.front());
        }
        verifyLaw(powers, variance);
    }

    void onePowerForAPing_data()
    {
        QTest::addColumn<int>("fluctuation");
        QTest::addColumn<double>("variance");
        QTest::newRow("Swerling 2") << int(Fluctuation::Swerling2) << 1.0;
        QTest::newRow("Swerling 4") << int(Fluctuation::Swerling4) << 0.5;
    }

    void onePowerForAPing()
    {
        QFETCH(int, fluctuation);
        QFETCH(double, variance);
        const std::vector<double> powers = addedPowers(static_cast<Fluctuation>(fluctuation), 4000, 3);
        verifyLaw(powers, variance);
        double product = 0.0; // of neighbours, which are independent
        for (std::size_t i = 1; i < powers.size(); ++i)
            product += powers[i] * powers[i - 1] / double(powers.size() - 1);
        QVERIFY2(std::abs(product - 1.0) < 4.5 * std::sqrt(3.0 / 4000.0), qPrintable(QString::number(product)));
    }

    // A constant phase with a power of Swerling 2 in each ping is a complex normal amplitude: y ~ (1 + S)·Exp(1).
    void fluctuatingAmplitudeIsExponential()
    {
        const int pings = 4000;
        const double snr = 5.0;
        const std::vector<float> y =
            targetCell(Echo::Complex, 10.0 * std::log10(snr), pings, 1, Fluctuation::Swerling2);
        for (const double level : {1.0, 4.0, 12.0, 20.0}) {
            const double p = std::exp(-level / (1.0 + snr));
            const auto above =
                std::count_if(y.begin(), y.end(), [level](float value) { return double(value) > level; });
            QVERIFY2(std::abs(double(above) / pings - p) < 4.5 * std::sqrt(p * (1.0 - p) / pings),
                     qPrintable(QString("above %1").arg(level)));
        }
    }

    void reverberationIsTakenOut_data()
    {
        QTest::addColumn<int>("normalisation");
        QTest::addColumn<int>("looks");
        QTest::newRow("known mean") << 0 << 1;
        QTest::newRow("estimated mean") << 1 << 1;
        QTest::newRow("estimated mean, three looks") << 1 << 3;
    }

    void reverberationIsTakenOut()
    {
        QFETCH(int, normalisation);
        QFETCH(int, looks);
        PingScene made = scene(300, looks);
        made.reverberation = Reverberation{20.0, 3.0, static_cast<PingNormalisation>(normalisation)};
        const SimulatedPings pings(made);
        const std::vector<float> y = allOf(pings);
        // Mean 1 at every range: per ring of ranges, to its own error. The curved background biases an estimate by up to
        // half a percent.
        const double bias = normalisation == 1 ? 0.006 : 0.0;
        for (Index first = 8; first + 20 <= 200; first += 20) {
            double sum = 0.0;
            double count = 0.0;
            for (Index ping = 0; ping < 300; ++ping)
                for (Index cell = first * 10; cell < (first + 20) * 10; ++cell) {
                    sum += double(y[std::size_t(ping * 2000 + cell)]);
                    count += 1.0;
                }
            QVERIFY2(std::abs(sum / count - 1.0) < bias + 4.5 / std::sqrt(count * looks),
                     qPrintable(QString("ranges from %1: %2").arg(first).arg(sum / count)));
        }
    }
};

FAINTLINE_TEST(tst_SimulatedPings)
#include "tst_SimulatedPings.moc"
