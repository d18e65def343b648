#include "noise/pings/NormalisedPings.h"
#include "support/frames.h"
#include "support/test.h"

#include "base/Random.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace faintline;
using namespace faintline::test;

namespace {

/// Pings of three range cells and two beams, held in memory.
class Held : public RawPings
{
public:
    Held(std::vector<double> numbers, bool isComplex = false, double quantum = 0.0) : m_numbers(std::move(numbers))
    {
        m_info.grid = Grid{{{"range", "m", 0.0, 1.0, 3, false}, {"bearing", "°", 0.0, 180.0, 2, true}}};
        m_info.isComplex = isComplex;
        m_info.quantum = quantum;
        m_info.time = {"time", "s", 0.0, 1.0, std::ssize(m_numbers) / (isComplex ? 12 : 6), false};
    }

    void read(Index first, Index count, std::span<double> out) const override
    {
        const Index each = m_info.isComplex ? 12 : 6;
        std::copy_n(m_numbers.begin() + first * each, count * each, out.begin());
    }

private:
    std::vector<double> m_numbers;
};

std::vector<double> numbers(std::size_t count, std::uint64_t seed)
{
    Random random(seed, 1);
    std::vector<double> made(count);
    for (double &number : made)
        number = 20.0 * random.uniform() - 2.0; // some are negative
    return made;
}

double medianOf(std::vector<double> values)
{
    std::erase_if(values, [](double value) { return !(value > 0.0); });
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

} // namespace

/// Recorded pings as power, against the formulas and a sorted list for the unit.
class tst_PingPower : public QObject
{
    Q_OBJECT

private slots:
    void everyKindOfValue_data()
    {
        QTest::addColumn<int>("kind");
        QTest::newRow("power") << int(PingValues::Power);
        QTest::newRow("magnitude") << int(PingValues::Magnitude);
        QTest::newRow("decibels") << int(PingValues::Decibels);
    }

    void everyKindOfValue()
    {
        QFETCH(int, kind);
        const auto values = static_cast<PingValues>(kind);
        std::vector<double> raw = numbers(36, 7);
        raw[4] = std::numeric_limits<double>::quiet_NaN();
        raw[5] = std::numeric_limits<double>::infinity();
        std::vector<double> expected;
        for (const double x : raw)
            expected.push_back(values == PingValues::Magnitude  ? x * x
                               : values == PingValues::Decibels ? std::pow(10.0, x / 10.0)
                               : std::isnan(x)                  ? x
                                                                : std::max(x, 0.0));
        expected[5] = raw[4];
        const double unit = medianOf(expected); // of six pings, which are among the first eight
        const std::vector<float> y = allOf(PingPower(std::make_shared<Held>(raw), values));
        for (std::size_t i = 0; i < y.size(); ++i) {
            if (i == 5 || (i == 4 && values != PingValues::Power))
                QVERIFY(std::isnan(y[i])); // not observed
            else if (i != 4)
                QVERIFY2(std::abs(double(y[i]) - expected[i] / unit) <= 1e-6 * (1.0 + expected[i] / unit),
                         qPrintable(QString::number(i)));
        }
    }

    void complexPingsAreIAndQ()
    {
        const std::vector<double> raw = numbers(24, 8);
        std::vector<double> expected;
        for (std::size_t i = 0; i < 12; ++i)
            expected.push_back(raw[2 * i] * raw[2 * i] + raw[2 * i + 1] * raw[2 * i + 1]);
        const double unit = medianOf(expected);
        const std::vector<float> y = allOf(PingPower(std::make_shared<Held>(raw, true), PingValues::Decibels));
        QCOMPARE(y.size(), std::size_t(12)); // the kind of values does not matter
        for (std::size_t i = 0; i < 12; ++i)
            QVERIFY(std::abs(double(y[i]) - expected[i] / unit) < 1e-5);
    }

    void theUnitIsTheMedianOfTheFirstPings()
    {
        std::vector<double> raw(48, 4.0);   // eight pings of 4 …
        raw.insert(raw.end(), 600, 1000.0); // … before a hundred of 1000
        const std::vector<float> y = allOf(PingPower(std::make_shared<Held>(raw), PingValues::Power));
        QCOMPARE(y.front(), 1.0f);
        QCOMPARE(y.back(), 250.0f);
    }

    void integersAreSpreadOverTheirStep()
    {
        constexpr double level = 100.0, step = 2.0;
        const std::vector<double> raw(6000, level);
        const std::vector<float> y = allOf(PingPower(std::make_shared<Held>(raw, false, step), PingValues::Power));
        // The unit is near the level, so that y times it lies within half a step, evenly.
        const double unit =
            level / (double(*std::max_element(y.begin(), y.end()) + *std::min_element(y.begin(), y.end())) / 2.0);
        std::vector<int> quarters(4, 0);
        for (const float value : y) {
            const double within = (double(value) * unit - level) / step + 0.5;
            QVERIFY2(within > -0.01 && within < 1.01, qPrintable(QString::number(within)));
            ++quarters[std::size_t(std::clamp(int(4.0 * within), 0, 3))];
        }
        for (const int count : quarters) // 1500 each, within four binomial deviations
            QVERIFY2(std::abs(count - 1500) < 4.0 * std::sqrt(6000.0 * 0.25 * 0.75),
                     qPrintable(QString::number(count)));
    }

    void partsAreThoseOfTheWhole()
    {
        for (const bool isComplex : {false, true}) {
            const PingPower power(std::make_shared<Held>(numbers(240, 9), isComplex, 1.0), PingValues::Power);
            const std::vector<float> whole = allOf(power);
            for (Index first = 0; first < power.time().count; first += 3) {
                const Index count = std::min<Index>(3, power.time().count - first);
                std::vector<float> part(std::size_t(6 * count));
                power.read(first, count, part);
                QVERIFY(std::equal(part.begin(), part.end(), whole.begin() + 6 * first));
            }
        }
    }

    void silentPingsKeepTheirUnit()
    {
        const std::vector<float> y =
            allOf(PingPower(std::make_shared<Held>(std::vector<double>(12, 0.0)), PingValues::Power));
        QCOMPARE(y, std::vector<float>(12, 0.0f));
    }
};

FAINTLINE_TEST(tst_PingPower)
#include "tst_PingPower.moc"
