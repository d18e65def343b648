#include "noise/NormalisedPower.h"
#include "support/frames.h"
#include "support/test.h"

#include "support/recordings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace faintline;
using namespace faintline::test;

namespace {

/// Power held in memory: frames × cells.
class MemoryPower final : public PowerFrames
{
public:
    MemoryPower(Index frames, Index cells, std::vector<float> values) : m_values(std::move(values))
    {
        m_info.path = "memory";
        m_info.time = {"time", "s", 0.5, 1.0, frames, false};
        m_info.frequency = {"frequency", "Hz", 1000.0, 2.0, cells, false};
    }

    PowerInfo &mutableInfo() { return m_info; }

    void read(const PowerPart &part, std::span<float> out) const override
    {
        for (Index frame = 0; frame < part.frames; ++frame)
            std::copy_n(m_values.begin() + (part.firstFrame + frame) * m_info.frequency.count + part.firstCell,
                        part.cells, out.begin() + frame * part.cells);
    }

private:
    std::vector<float> m_values;
};

constexpr Index frameCount = 400;
constexpr Index cellCount = 300;

/// Means of K looks at noise behind a passband.
std::vector<float> looks(int k, std::uint64_t stream)
{
    std::vector<float> values(std::size_t(frameCount * cellCount), 0.0f);
    std::vector<float> look(values.size());
    Random random(101, stream);
    for (int i = 0; i < k; ++i) {
        random.exponentials(look);
        for (std::size_t at = 0; at < values.size(); ++at)
            values[at] += look[at] / float(k);
    }
    for (std::size_t at = 0; at < values.size(); ++at)
        values[at] *= 1e4f * (1.5f + std::sin(float(at % cellCount) / 40.0f));
    return values;
}

NormaliserSettings settings()
{
    NormaliserSettings made{.halfWidthCells = 12, .blockWindows = 100.0};
    return made;
}

std::shared_ptr<MemoryPower> memory(std::vector<float> values)
{
    return std::make_shared<MemoryPower>(frameCount, cellCount, std::move(values));
}

NormalisedPower normalised(const std::shared_ptr<const PowerFrames> &power)
{
    return {power, partOf(power->info(), {}), settings()};
}

/// -ln Q(K, Kx) of a whole K: the logarithm of a Poisson sum.
double lawOf(int k, double x)
{
    double term = 1.0;
    double sum = 1.0;
    for (int i = 1; i < k; ++i) {
        term *= double(k) * x / i;
        sum += term;
    }
    return double(k) * x - std::log(sum);
}

/// The x below which noise of K looks lies with that probability.
double quantileOf(int k, double p)
{
    double low = 0.0;
    double high = 1.0 + 20.0 / std::sqrt(double(k));
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (1.0 - std::exp(-lawOf(k, middle)) < p ? low : high) = middle;
    }
    return low;
}

} // namespace

/// Power of files over its noise: Poisson sums for the law of looks, and noise whose law is known.
class tst_NormalisedPower : public QObject
{
    Q_OBJECT

private slots:
    void lawIsAPoissonSum_data()
    {
        QTest::addColumn<int>("looksAveraged");
        for (const int k : {1, 2, 7, 50, 200})
            QTest::addRow("%d looks", k) << k;
    }

    void lawIsAPoissonSum()
    {
        QFETCH(int, looksAveraged);
        const LooksLaw law(looksAveraged, quantileOf(looksAveraged, 0.5));
        for (double x = looksAveraged < 50 ? 0.1 : 0.6; x < 3.0; x *= 1.03) {
            const double expected = lawOf(looksAveraged, x);
            if (expected < 1e-6) // a sum near 1 has no digits left
                continue;
            const auto found = double(law(float(x)));
            QVERIFY2(std::abs(found - expected) <= 1e-3 * expected + 1e-6,
                     qPrintable(QString("%1: %2, not %3").arg(x).arg(found).arg(expected)));
        }
        float before = law(0.0f);
        for (float x = 0.0f; x < 50.0f; x += 0.05f) { // and goes on beyond its table
            QVERIFY(law(x) >= before && std::isfinite(law(x)));
            before = law(x);
        }
        // A median that is off by a factor is taken for B's fault.
        const LooksLaw shifted(looksAveraged, 2.0 * quantileOf(looksAveraged, 0.5));
        QVERIFY(std::abs(double(shifted(2.0f)) - lawOf(looksAveraged, 1.0)) < 1e-3);
    }

    void looksAreToldByTheSpread_data() { lawIsAPoissonSum_data(); }

    void looksAreToldByTheSpread()
    {
        QFETCH(int, looksAveraged);
        for (const double scale : {1.0, 7.0}) {
            const LooksLaw law =
                LooksLaw::fromQuantiles(scale * quantileOf(looksAveraged, 0.16), scale * quantileOf(looksAveraged, 0.5),
                                        scale * quantileOf(looksAveraged, 0.84));
            QVERIFY2(std::abs(law.looks() / looksAveraged - 1.0) < 1e-6, qPrintable(QString::number(law.looks())));
            QVERIFY(std::abs(law.median() / (scale * quantileOf(looksAveraged, 0.5)) - 1.0) < 1e-6);
        }
    }

    void noiseBecomesExponential_data()
    {
        QTest::addColumn<int>("looksAveraged");
        for (const int k : {1, 4, 30})
            QTest::addRow("%d looks", k) << k;
    }

    void noiseBecomesExponential()
    {
        QFETCH(int, looksAveraged);
        const NormalisedPower power = normalised(memory(looks(looksAveraged, std::uint64_t(looksAveraged))));
        QVERIFY2(std::abs(power.looks() / looksAveraged - 1.0) < 0.06, qPrintable(QString::number(power.looks())));
        const std::vector<float> y = allOf(power);
        for (const double t : {0.1, 0.7, 2.0, 4.0}) {
            const double share =
                double(std::count_if(y.begin(), y.end(), [&](float v) { return double(v) > t; })) / double(y.size());
            QVERIFY2(std::abs(share / std::exp(-t) - 1.0) < 0.04 + 0.02 * t,
                     qPrintable(QString("beyond %1: %2").arg(t).arg(share)));
        }
        QCOMPARE(power.time().count, frameCount);
        QCOMPARE(power.grid().axes.front().first, 1000.0);
    }

    void framesOfAnotherLevelAreBroughtToIt()
    {
        std::vector<float> values = looks(4, 41);
        const std::vector<float> before = allOf(normalised(memory(values)));
        for (Index cell = 0; cell < cellCount; ++cell)
            values[std::size_t(200 * cellCount + cell)] *= 5.0f;
        const std::vector<float> after = allOf(normalised(memory(values)));
        double sum = 0.0;
        for (Index cell = 0; cell < cellCount; ++cell)
            sum += double(after[std::size_t(200 * cellCount + cell)]);
        QVERIFY2(std::abs(sum / cellCount - 1.0) < 0.25, qPrintable(QString::number(sum / cellCount)));
        for (Index cell = 0; cell < cellCount; ++cell) {
            const auto at = std::size_t(201 * cellCount + cell);
            QVERIFY(std::abs(after[at] - before[at]) < 0.05f * (1.0f + before[at]));
        }
    }

    void theUnitDoesNotMatter()
    {
        std::vector<float> values = looks(4, 42);
        const std::vector<float> before = allOf(normalised(memory(values)));
        for (float &value : values)
            value *= 0x1p-60f;
        const std::vector<float> after = allOf(normalised(memory(values)));
        for (std::size_t i = 0; i < before.size(); ++i)
            QVERIFY(std::abs(after[i] - before[i]) < 1e-3f * (1.0f + before[i]));
    }

    void whatWasNotObserved()
    {
        std::vector<float> values = looks(4, 43);
        const auto at = [](Index frame, Index cell) { return std::size_t(frame * cellCount + cell); };
        values[at(7, 5)] = std::numeric_limits<float>::quiet_NaN();
        values[at(8, 5)] = std::numeric_limits<float>::infinity();
        values[at(9, 5)] = -1e6f;
        const std::vector<float> y = allOf(normalised(memory(values)));
        QVERIFY(std::isnan(y[at(7, 5)]));
        QVERIFY(std::isnan(y[at(8, 5)]));
        QVERIFY(y[at(9, 5)] >= 0.0f && y[at(9, 5)] < 1e-3f); // no power
        QCOMPARE(std::count_if(y.begin(), y.end(), [](float v) { return std::isnan(v); }), std::ptrdiff_t(2));
    }

    // 0 … 3: noise has a law all the same.
    void fewBitsHaveAMedian()
    {
        std::vector<float> values(std::size_t(frameCount * cellCount));
        Random(101, 44).exponentials(values);
        for (float &value : values)
            value = std::min(3.0f, std::floor(2.0f * value));
        const auto power = memory(values);
        power->mutableInfo().quantum = 1.0;
        const std::vector<float> y = allOf(normalised(power));
        double sum = 0.0;
        for (const float value : y)
            sum += double(value);
        QVERIFY2(std::abs(sum / double(y.size()) - 1.0) < 0.15, qPrintable(QString::number(sum / double(y.size()))));
        std::vector<float> sorted = y;
        std::sort(sorted.begin(), sorted.end());
        QVERIFY(std::abs(sorted[sorted.size() / 2] - std::log(2.0f)) < 0.06f);
        QVERIFY(y == allOf(normalised(power))); // the same numbers each time
    }

    void framesAreAFunctionOfTheirIndex()
    {
        const auto source = memory(looks(2, 45));
        source->mutableInfo().quantum = 1.0;
        const NormalisedPower power(source, {0, 20, 350, 10, 280}, settings());
        const std::vector<float> whole = allOf(power);
        QCOMPARE(power.time().first, 20.5);
        QCOMPARE(power.grid().axes.front().first, 1020.0);
        Random random(101, 46);
        for (int i = 0; i < 30; ++i) {
            const auto first = Index(random.uniform() * 350.0);
            const Index count = 1 + Index(random.uniform() * double(350 - first));
            std::vector<float> piece(std::size_t(count * 280));
            power.read(first, count, piece);
            QVERIFY(std::equal(piece.begin(), piece.end(), whole.begin() + first * 280));
        }
    }

    void partsOfAFile()
    {
        const auto power = memory(looks(1, 47));
        const auto part = [&](double from, double to, double low, double high) {
            SelectionSettings selection{.fromSeconds = from, .toSeconds = to, .lowHz = low, .highHz = high};
            const PowerPart found = partOf(power->info(), selection);
            return std::array<Index, 4>{found.firstFrame, found.frames, found.firstCell, found.cells};
        };
        using Four = std::array<Index, 4>;
        QCOMPARE(part(0.0, 0.0, 0.0, 0.0), (Four{0, 400, 0, 300}));
        QCOMPARE(part(10.0, 20.0, 1003.0, 1010.0), (Four{10, 10, 2, 4})); // frames at 10½ … 19½, cells at 1004 … 1010
        QCOMPARE(part(10.5, 0.0, 0.0, 1e9), (Four{10, 390, 0, 300}));
        QCOMPARE(part(0.0, 0.0, -1e300, 1000.0), (Four{0, 400, 0, 1}));
    }

    void refusals()
    {
        const auto power = memory(looks(1, 48));
        const auto refusal = [&](const SelectionSettings &selection) {
            return errorOf([&] { partOf(power->info(), selection); });
        };
        SelectionSettings selection;
        selection.channel = 1;
        QCOMPARE(refusal(selection), std::string("selection.channel = 1: memory has 1 channel(s), counted from 0"));
        selection.channels = {1.0};
        QCOMPARE(refusal(selection), std::string("selection.channels = 1: memory has 1 channel(s), counted from 0"));
        selection = {};
        selection.fromSeconds = 900.0;
        QCOMPARE(refusal(selection),
                 std::string("selection.fromSeconds, selection.toSeconds: selects nothing of memory, "
                             "which extends from 0.5 to 399.5 s"));
        selection = {};
        selection.lowHz = 1000.5;
        selection.highHz = 1001.5;
        QCOMPARE(
            refusal(selection),
            std::string("selection.lowHz, selection.highHz: selects nothing of memory, which extends from 1000 to 1598 "
                        "Hz"));
        NormaliserSettings causal = settings();
        causal.causal = true;
        QCOMPARE(errorOf([&] { NormalisedPower(power, partOf(power->info(), {}), causal); }),
                 std::string("noise.causal = true: requires samples; memory holds power over time and frequency"));
        QCOMPARE(
            errorOf([&] { normalised(memory(std::vector<float>(std::size_t(frameCount * cellCount), 0.0f))); }),
            std::string("memory: holds no power in most of its channels: their values are 0, negative or not finite"));
    }

    void cancels()
    {
        const auto power = memory(looks(1, 49));
        std::stop_source source;
        source.request_stop();
        RunContext context;
        context.stop = source.get_token();
        QVERIFY_THROWS_EXCEPTION(Cancelled, NormalisedPower(power, partOf(power->info(), {}), settings(), context));
    }
};

FAINTLINE_TEST(tst_NormalisedPower)
#include "tst_NormalisedPower.moc"
