#include "noise/levels.h"
#include "support/test.h"

#include "base/Random.h"

#include <array>
#include <cmath>

using namespace faintline;

namespace {

/// A random walk and noise laid over it.
struct Walk {
    std::vector<float> walk;
    std::vector<float> series;

    Walk(std::size_t length, double step, double noise, std::uint64_t stream)
    {
        Random random(31, stream);
        double level = 0.0;
        for (std::size_t i = 0; i < length; ++i) {
            level += step * random.normal();
            walk.push_back(float(level));
            series.push_back(float(level + noise * random.normal()));
        }
    }
};

double deviation(const std::vector<float> &a, const std::vector<float> &b)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::pow(double(a[i] - b[i]), 2.0);
    return std::sqrt(sum / double(a.size()));
}

} // namespace

/// The level of noise from its cells, and what a series of levels tells.
class tst_levels : public QObject
{
    Q_OBJECT

private slots:
    void mediansOfExponentials()
    {
        QCOMPARE(medianMean(1), 1.0);
        QCOMPARE(medianMean(2), 0.5); // the smaller of two
        QCOMPARE(medianMean(3), 1.0 / 3 + 1.0 / 2);
        QVERIFY(std::abs(medianMean(100001) - std::log(2.0)) < 1e-5);
        std::vector<float> four{4.0f, 1.0f, 3.0f, 2.0f};
        QCOMPARE(medianOf(four), 2.0f);
    }

    void exponentialMediansAreMedians()
    {
        for (const std::size_t count : {1, 2, 3, 24, 96, 751, 5000})
            for (std::uint64_t stream = 0; stream < 20; ++stream) {
                std::vector<float> values(count);
                Random(33, stream).exponentials(values);
                std::vector<float> few = values; // of which many are equal
                for (float &value : few)
                    value = std::floor(2.0f * value);
                std::vector<float> sorted = values;
                std::vector<float> sortedFew = few;
                for (const float expected : {0.7f, 0.6f, 1e-3f, 1e3f}) {
                    QCOMPARE(exponentialMedian(values, expected), medianOf(sorted));
                    QCOMPARE(exponentialMedian(few, expected), medianOf(sortedFew));
                }
            }
        QCOMPARE(exponentialMedian(std::vector<float>(50, 0.0f), 1.0f), 0.0f);
    }

    void truncatedMeanOfExponentials()
    {
        Random random(32, 1);
        std::vector<float> cells(20000);
        for (float &cell : cells)
            cell = float(3.0 * random.exponential());
        const float mean = truncatedMean(cells, 3.0f);
        QVERIFY2(std::abs(mean / 3.0f - 1.0f) < 5.0f * 1.1f / std::sqrt(20000.0f), qPrintable(QString::number(mean)));
        // From a guess a tenth away it comes to the same within a three-hundredth.
        for (float guess : {2.7f, 3.3f})
            QVERIFY2(std::abs(truncatedMean(cells, guess) / mean - 1.0f) < 0.0033f,
                     qPrintable(QString::number(truncatedMean(cells, guess))));
        // However strong, twenty lines of 20000 cells do nothing to it.
        for (std::size_t i = 0; i < 20; ++i)
            cells[1000 * i] = 1e20f;
        QVERIFY(std::abs(truncatedMean(cells, 3.0f) / mean - 1.0f) < 0.003f);
        QCOMPARE(truncatedMean({}, 1.0f), 1.0f);
    }

    void meansOfCells()
    {
        // Cells of a Hann window: two neighbours share 4/9 of their power's fluctuation, the next 1/36.
        constexpr int cells = 96;
        Random random(32, 2);
        double sum = 0.0;
        constexpr int trials = 2000;
        for (int trial = 0; trial < trials; ++trial) {
            std::array<double, cells + 2> re{};
            std::array<double, cells + 2> im{};
            for (std::size_t i = 0; i < re.size(); ++i) {
                re[i] = random.normal();
                im[i] = random.normal();
            }
            std::vector<float> y;
            for (std::size_t i = 1; i + 1 < re.size(); ++i)
                y.push_back(float((std::pow(re[i] - 0.5 * (re[i - 1] + re[i + 1]), 2.0)
                                   + std::pow(im[i] - 0.5 * (im[i - 1] + im[i + 1]), 2.0))
                                  / 3.0));
            sum += std::pow(std::log(double(truncatedMean(y, 1.0f))), 2.0);
        }
        const double measured = std::sqrt(sum / trials);
        QVERIFY2(std::abs(measured / meanScatter(cells, 35.0 / 18.0) - 1.0) < 0.1,
                 qPrintable(QString::number(measured)));
    }

    void aWalkIsFollowed()
    {
        // Steps of a quarter of the noise: the best smoother leaves √(q·r)/2 of variance, a third of the noise's deviation.
        const Walk w(2000, 0.25, 1.0, 1);
        const double left = deviation(beyondScatter(w.series, 1.0), w.walk);
        QVERIFY2(left > 0.25 && left < 0.45, qPrintable(QString::number(left)));
    }

    void scatterIsNotFollowed()
    {
        // The mean of some 200 values would have a deviation of 0.07.
        const std::vector<float> level = beyondScatter(Walk(20000, 0.0, 1.0, 2).series, 1.0);
        const double left = deviation(level, std::vector<float>(level.size(), 0.0f));
        QVERIFY2(left < 0.15, qPrintable(QString::number(left)));
    }

    void stepsAndClicksAreKept()
    {
        Walk w(2000, 0.0, 1.0, 4);
        for (std::size_t i = 700; i < 1400; ++i)
            w.walk[i] += 30.0f;
        w.walk[100] += 50.0f;
        for (std::size_t i = 0; i < w.series.size(); ++i)
            w.series[i] += w.walk[i];
        const std::vector<float> level = beyondScatter(w.series, 1.0);
        for (std::size_t i = 0; i < level.size(); ++i)
            QVERIFY2(std::abs(level[i] - w.walk[i]) < 4.5f, qPrintable(QString::number(i)));
        // Away from them it is averaged as if they were not there.
        double sum = 0.0;
        for (std::size_t i = 1000; i < 1200; ++i)
            sum += std::pow(double(level[i] - 30.0f), 2.0) / 200.0;
        QVERIFY2(std::sqrt(sum) < 0.4, qPrintable(QString::number(std::sqrt(sum))));
    }

    void aRampCostsNothing()
    {
        Walk w(2000, 0.0, 1.0, 5);
        for (std::size_t i = 0; i < w.series.size(); ++i) {
            w.walk[i] = 0.2f * float(i);
            w.series[i] += w.walk[i];
        }
        const std::vector<float> level = beyondScatter(w.series, 1.0);
        double sum = 0.0;
        for (std::size_t i = 200; i < 1800; ++i)
            sum += std::pow(double(level[i] - w.walk[i]), 2.0) / 1600.0;
        QVERIFY2(std::sqrt(sum) < 0.2, qPrintable(QString::number(std::sqrt(sum))));
    }

    void swingsAreFollowed()
    {
        // Periods from 6 values, which are kept as they are, to 1000, which are averaged over dozens: always less is left
        // than there was.
        for (const auto &[period, most] : {std::pair{6.0, 1.05}, {30.0, 0.75}, {200.0, 0.4}, {1000.0, 0.25}}) {
            Walk w(4000, 0.0, 1.0, 6);
            for (std::size_t i = 0; i < w.series.size(); ++i) {
                w.walk[i] = float(10.0 * std::sin(6.2832 * double(i) / period));
                w.series[i] += w.walk[i];
            }
            const double left = deviation(beyondScatter(w.series, 1.0), w.walk);
            QVERIFY2(left < most, qPrintable(QString("%1: %2").arg(period).arg(left)));
        }
    }

    void shortSeries()
    {
        QVERIFY(beyondScatter({}, 1.0).empty());
        QCOMPARE(beyondScatter({7.0f}, 1.0), std::vector<float>{7.0f});
        for (const float value : beyondScatter({3.0f, 3.0f, 3.0f}, 1.0))
            QVERIFY(std::abs(value - 3.0f) < 1e-5f);
    }
};

FAINTLINE_TEST(tst_levels)
#include "tst_levels.moc"
