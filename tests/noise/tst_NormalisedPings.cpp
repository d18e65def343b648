#include "noise/pings/NormalisedPings.h"
#include "support/test.h"

#include "base/Random.h"
#include "base/logmath.h"
#include "noise/pings/guessPingValues.h"
#include "support/errors.h"
#include "support/frames.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

using namespace faintline;
using namespace faintline::test;

namespace {

/// Pings in memory.
class ArrayPings final : public RawPings
{
public:
    ArrayPings(Index pings, const Grid &grid, std::vector<double> values) : m_values(std::move(values))
    {
        m_info.path = "memory";
        m_info.sampleType = "test";
        m_info.time = {"time", "s", 0.0, 10.0, pings, false};
        m_info.grid = grid;
    }

    PingsInfo &info() { return m_info; }

    void read(Index first, Index count, std::span<double> out) const override
    {
        const Index perPing = cells() * (m_info.isComplex ? 2 : 1);
        std::copy_n(m_values.begin() + first * perPing, count * perPing, out.begin());
    }

private:
    std::vector<double> m_values;
};

constexpr Index pings = 96;
constexpr Index ranges = 400;
constexpr Index beams = 16;
constexpr Index pingCells = ranges * beams;

Grid sea()
{
    return {{{"range", "m", 100.0, 5.0, ranges, false}, {"bearing", "°", 0.0, 22.5, beams, true}}};
}

/// Mean power of a cell: reverberation that falls by 60 dB with r⁻⁴, steepest at short range, down to the noise of the
/// sea, and beams whose gains differ by up to ±10 dB.
double meanPower(Index cell, double slopeDb, double gainDb)
{
    const double range = 1.0 + 14.0 * double(cell / beams) / double(ranges);
    const double fall = std::pow(range, -4.0 * slopeDb / 47.0);
    const double gain = ratioFromDb(gainDb * std::sin(2.6 * double(cell % beams) + 1.0));
    return (fall + ratioFromDb(-slopeDb)) * gain;
}

/// I and Q of noise with these mean powers, unit mean square.
std::vector<double> noiseIq(double slopeDb, double gainDb, int seed = 7)
{
    std::vector<float> unit(std::size_t(2 * pings * pingCells));
    Random(std::uint64_t(seed), 0).normals(unit, std::numbers::sqrt2_v<float> / 2.0f);
    std::vector<double> values(unit.begin(), unit.end());
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] *= std::sqrt(meanPower(Index(i / 2) % pingCells, slopeDb, gainDb));
    return values;
}

std::vector<double> powersOf(const std::vector<double> &iq)
{
    std::vector<double> power(iq.size() / 2);
    for (std::size_t i = 0; i < power.size(); ++i)
        power[i] = iq[2 * i] * iq[2 * i] + iq[2 * i + 1] * iq[2 * i + 1];
    return power;
}

enum class Stored { Power, Int16Magnitude, Int16Iq, Decibels, Uint8Decibels };

/// The same noise as a file would hold it. Full scale of int16 is 12 dB above the loudest cell's mean.
std::shared_ptr<ArrayPings> stored(Stored as, const std::vector<double> &iq)
{
    std::vector<double> values = powersOf(iq);
    const double loudest = ratioFromDb(10.0);
    const double full = 32767.0 / std::sqrt(loudest * ratioFromDb(12.0));
    double quantum = 0.0;
    if (as == Stored::Int16Magnitude) {
        for (double &value : values)
            value = std::clamp(std::round(full * std::sqrt(value)), 0.0, 32767.0);
        quantum = 1.0;
    } else if (as == Stored::Int16Iq) {
        values = iq;
        for (double &value : values)
            value = std::clamp(std::round(full * value), -32768.0, 32767.0);
        quantum = 1.0;
    } else if (as == Stored::Decibels) {
        for (double &value : values)
            value = 10.0 * std::log10(value);
    } else if (as == Stored::Uint8Decibels) {
        for (double &value : values)
            value = 0.5 * std::clamp(std::round(2.0 * (10.0 * std::log10(value) + 100.0)), 0.0, 255.0) - 100.0;
        quantum = 0.5;
    }
    auto result = std::make_shared<ArrayPings>(pings, sea(), std::move(values));
    result->info().quantum = quantum;
    result->info().isComplex = as == Stored::Int16Iq;
    return result;
}

PingValues kindOf(Stored as)
{
    return as == Stored::Power                                     ? PingValues::Power
           : as == Stored::Int16Magnitude || as == Stored::Int16Iq ? PingValues::Magnitude
                                                                   : PingValues::Decibels;
}

std::vector<float> normalised(std::shared_ptr<const RawPings> raw, PingValues values,
                              const PingNoiseSettings &settings = {})
{
    const Index count = raw->info().time.count;
    const NormalisedPings made(std::move(raw), values, false, settings);
    std::vector<float> y(std::size_t(count * made.grid().size()));
    made.read(0, count, y);
    return y;
}

double meanOf(const std::vector<float> &y, const std::function<bool(Index cell)> &belongs)
{
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i)
        if (belongs(Index(i) % pingCells) && !std::isnan(y[i])) {
            sum += double(y[i]);
            count += 1.0;
        }
    return sum / count;
}

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

/// Recorded pings over their noise: mean 1 and an exponential law in every cell, echoes kept.
class tst_NormalisedPings : public QObject
{
    Q_OBJECT

private slots:
    void noiseIsExponentialOfMeanOne_data()
    {
        QTest::addColumn<int>("as");
        QTest::addColumn<double>("slopeDb");
        QTest::addColumn<double>("gainDb");
        QTest::newRow("level") << int(Stored::Power) << 0.0 << 0.0;
        QTest::newRow("reverberation") << int(Stored::Power) << 60.0 << 10.0;
        QTest::newRow("int16 magnitude") << int(Stored::Int16Magnitude) << 60.0 << 10.0;
        QTest::newRow("int16 I/Q") << int(Stored::Int16Iq) << 60.0 << 10.0;
        QTest::newRow("decibels") << int(Stored::Decibels) << 60.0 << 10.0;
        QTest::newRow("uint8 decibels") << int(Stored::Uint8Decibels) << 60.0 << 10.0;
    }

    void noiseIsExponentialOfMeanOne()
    {
        QFETCH(int, as);
        QFETCH(double, slopeDb);
        QFETCH(double, gainDb);
        const auto kind = static_cast<Stored>(as);
        const std::vector<float> y = normalised(stored(kind, noiseIq(slopeDb, gainDb)), kindOf(kind));
        const double mean = meanOf(y, [](Index) { return true; });
        QVERIFY2(std::abs(mean - 1.0) < 0.01, qPrintable(QString::number(mean)));
        for (Index beam = 0; beam < beams; ++beam) {
            const double own = meanOf(y, [&](Index cell) { return cell % beams == beam; });
            QVERIFY2(std::abs(own - 1.0) < 0.03, qPrintable(QString("beam %1: %2").arg(beam).arg(own)));
        }
        for (Index part = 0; part < 40; ++part) { // ten range cells in all beams
            const double own = meanOf(y, [&](Index cell) { return cell / beams / 10 == part; });
            QVERIFY2(std::abs(own - 1.0) < 0.05, qPrintable(QString("ranges %1: %2").arg(part * 10).arg(own)));
        }
        // P(y > t) = e^-t, within 5 % and four deviations, and 15 % in the far tail.
        for (const double t : {0.1, 1.0, 3.0, 6.0, 9.0}) {
            const auto above =
                double(std::count_if(y.begin(), y.end(), [&](float value) { return double(value) > t; }));
            const double expected = double(y.size()) * std::exp(-t);
            const double allowed = (t < 7.0 ? 0.05 : 0.15) * expected + 4.0 * std::sqrt(expected);
            QVERIFY2(std::abs(above - expected) < allowed,
                     qPrintable(QString("above %1: %2, expected %3").arg(t).arg(above).arg(expected)));
        }
    }

    void echoesAreKept_data()
    {
        QTest::addColumn<int>("cellsPerPing");
        QTest::addColumn<int>("extent");
        QTest::newRow("a point that stays for all pings") << 0 << 1;
        QTest::newRow("a point that moves") << 2 << 1;
        QTest::newRow("three cells that stay") << 0 << 3;
    }

    /// An echo's mean, 12 dB over the noise of its own cell, is reduced by less than 0.1 dB.
    void echoesAreKept()
    {
        QFETCH(int, cellsPerPing);
        QFETCH(int, extent);
        const double snr = ratioFromDb(12.0);
        std::vector<double> power = powersOf(noiseIq(60.0, 10.0));
        constexpr Index echoes = 13; // each in another beam and range
        const auto places = [&](Index ping) {
            std::vector<std::size_t> result;
            for (Index echo = 0; echo < echoes; ++echo)
                for (Index i = 0; i < extent; ++i) {
                    const Index range = (10 + 30 * echo + ping * cellsPerPing + i) % ranges;
                    result.push_back(std::size_t(ping * pingCells + range * beams + echo));
                }
            return result;
        };
        for (Index ping = 0; ping < pings; ++ping)
            for (const std::size_t at : places(ping))
                power[at] += snr * meanPower(Index(at) % pingCells, 60.0, 10.0);
        const std::vector<float> y =
            normalised(std::make_shared<ArrayPings>(pings, sea(), std::move(power)), PingValues::Power);
        double sum = 0.0;
        for (Index ping = 0; ping < pings; ++ping)
            for (const std::size_t at : places(ping))
                sum += double(y[at]);
        const double mean = sum / double(pings * extent * echoes) - 1.0;
        const double lossDb = dbFromRatio(snr) - dbFromRatio(mean);
        QVERIFY2(std::abs(lossDb) < 0.1, qPrintable(QString::number(lossDb)));
    }

    /// Six pings: 240 values for each cell's noise, whose error of 6 % lengthens the tail.
    void fewPings()
    {
        std::vector<double> power = powersOf(noiseIq(60.0, 10.0));
        power.resize(std::size_t(6 * pingCells));
        const std::vector<float> y =
            normalised(std::make_shared<ArrayPings>(6, sea(), std::move(power)), PingValues::Power);
        const double mean = meanOf(y, [](Index) { return true; });
        QVERIFY2(std::abs(mean - 1.0) < 0.03, qPrintable(QString::number(mean)));
    }

    void levelsOfPings()
    {
        std::vector<double> power = powersOf(noiseIq(60.0, 10.0));
        const auto factor = [](Index ping) { return ping % 3 == 1 ? 4.0 : ping == 50 ? 0.1 : 1.0; };
        for (std::size_t i = 0; i < power.size(); ++i)
            power[i] *= factor(Index(i) / pingCells);
        const auto raw = std::make_shared<ArrayPings>(pings, sea(), std::move(power));
        const auto meanOfPing = [](const std::vector<float> &y, Index ping) {
            return std::accumulate(y.begin() + ping * pingCells, y.begin() + (ping + 1) * pingCells, 0.0)
                   / double(pingCells);
        };
        const std::vector<float> followed = normalised(raw, PingValues::Power);
        for (const Index ping : {0, 1, 31, 50, 95}) {
            const double mean = meanOfPing(followed, ping);
            QVERIFY2(std::abs(mean - 1.0) < 0.06, qPrintable(QString("ping %1: %2").arg(ping).arg(mean)));
        }
        PingNoiseSettings settings;
        settings.followPing = false;
        const std::vector<float> asTheyAre = normalised(raw, PingValues::Power, settings);
        QVERIFY(meanOfPing(asTheyAre, 50) < 0.2);
        QVERIFY(meanOfPing(asTheyAre, 31) > 1.5);
    }

    /// A gain of one beam that rises by 6 dB over the recording.
    void slowChanges()
    {
        std::vector<double> power = powersOf(noiseIq(60.0, 10.0));
        for (std::size_t i = 0; i < power.size(); ++i)
            if (Index(i) % beams == 3)
                power[i] *= ratioFromDb(6.0 * double(Index(i) / pingCells) / double(pings));
        PingNoiseSettings settings;
        settings.blockPings = 16;
        const std::vector<float> y =
            normalised(std::make_shared<ArrayPings>(pings, sea(), std::move(power)), PingValues::Power, settings);
        for (const Index first : {8, 40, 80}) {
            double sum = 0.0;
            for (Index ping = first; ping < first + 8; ++ping)
                for (Index range = 0; range < ranges; ++range)
                    sum += double(y[std::size_t(ping * pingCells + range * beams + 3)]);
            QVERIFY2(std::abs(sum / (8.0 * ranges) - 1.0) < 0.08, qPrintable(QString::number(sum / (8.0 * ranges))));
        }
    }

    /// NaN, a beam without power and pings that are missing: not observed, and without influence on the rest.
    void unobservedCells()
    {
        std::vector<double> power = powersOf(noiseIq(60.0, 10.0));
        for (std::size_t i = 0; i < power.size(); ++i) {
            const Index ping = Index(i) / pingCells;
            if (Index(i) % beams == 2)
                power[i] = 0.0;
            if (ping % 4 == 1 || (Index(i) % pingCells) / beams == 77)
                power[i] = std::numeric_limits<double>::quiet_NaN();
        }
        const std::vector<float> y =
            normalised(std::make_shared<ArrayPings>(pings, sea(), std::move(power)), PingValues::Power);
        for (std::size_t i = 0; i < y.size(); ++i) {
            const bool isMissing =
                Index(i) % beams == 2 || (Index(i) / pingCells) % 4 == 1 || (Index(i) % pingCells) / beams == 77;
            QCOMPARE(std::isnan(y[i]), isMissing);
        }
        const double mean = meanOf(y, [](Index) { return true; });
        QVERIFY2(std::abs(mean - 1.0) < 0.01, qPrintable(QString::number(mean)));
    }

    void pastAlone()
    {
        PingNoiseSettings settings;
        settings.pastOnly = true;
        settings.blockPings = 24;
        std::vector<double> power = powersOf(noiseIq(60.0, 10.0));
        const std::vector<float> before =
            normalised(std::make_shared<ArrayPings>(pings, sea(), power), PingValues::Power, settings);
        for (std::size_t i = std::size_t(48 * pingCells); i < power.size(); ++i)
            power[i] *= 1.0 + double(i % 5);
        const std::vector<float> after =
            normalised(std::make_shared<ArrayPings>(pings, sea(), std::move(power)), PingValues::Power, settings);
        QVERIFY(std::equal(before.begin(), before.begin() + 48 * pingCells, after.begin()));
        QVERIFY(!std::equal(before.begin() + 48 * pingCells, before.end(), after.begin() + 48 * pingCells));
    }

    void piecesAreTheWhole()
    {
        const auto raw = stored(Stored::Int16Iq, noiseIq(60.0, 10.0));
        const NormalisedPings made(raw, PingValues::Power, false, {});
        std::vector<float> whole(std::size_t(pings * pingCells));
        made.read(0, pings, whole);
        for (const Index first : {0, 17, 90}) {
            std::vector<float> piece(std::size_t(6 * pingCells));
            made.read(first, 6, piece);
            QVERIFY(std::equal(piece.begin(), piece.end(), whole.begin() + first * pingCells));
        }
    }

    void guesses_data()
    {
        QTest::addColumn<int>("as");
        QTest::addColumn<double>("slopeDb");
        QTest::addColumn<int>("expected");
        QTest::newRow("normalised") << int(Stored::Power) << 0.0 << int(PingValues::Normalised);
        QTest::newRow("power") << int(Stored::Power) << 60.0 << int(PingValues::Power);
        QTest::newRow("int16 magnitude") << int(Stored::Int16Magnitude) << 60.0 << int(PingValues::Magnitude);
        QTest::newRow("decibels") << int(Stored::Decibels) << 60.0 << int(PingValues::Decibels);
        QTest::newRow("uint8 decibels") << int(Stored::Uint8Decibels) << 60.0 << int(PingValues::Decibels);
    }

    void guesses()
    {
        QFETCH(int, as);
        QFETCH(double, slopeDb);
        QFETCH(int, expected);
        std::vector<double> iq = noiseIq(slopeDb, slopeDb > 0.0 ? 10.0 : 0.0);
        if (slopeDb == 0.0)
            for (double &value : iq)
                value /= std::numbers::sqrt2; // reverberation and sea noise together are 2
        QCOMPARE(int(guessPingValues(*stored(static_cast<Stored>(as), iq))), expected);
    }

    void refusals()
    {
        const auto nothing =
            std::make_shared<ArrayPings>(4, sea(), std::vector<double>(std::size_t(4 * pingCells), 0.0));
        QCOMPARE(
            errorOf([&] { NormalisedPings(nothing, PingValues::Power, false, {}); }),
            std::string("memory: holds no power in most of its cells: their values are 0, negative or not finite"));
        const Grid huge{{{"range", "m", 0.0, 1.0, 4096, false}, {"bearing", "°", 0.0, 1.0, 512, false}}};
        const auto many = std::make_shared<ArrayPings>(1, huge, std::vector<double>(4096 * 512, 1.0));
        QVERIFY(contains(errorOf([&] { NormalisedPings(many, PingValues::Power, false, {}); }),
                         "has 2097152 cells in each ping; at most 1048576 can be normalised"));
    }

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

FAINTLINE_TEST(tst_NormalisedPings)
#include "tst_NormalisedPings.moc"
