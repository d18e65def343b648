#include "spectrum/levels.h"

#include "base/Random.h"

#include <QtTest>

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
            walk.push_back(static_cast<float>(level));
            series.push_back(static_cast<float>(level + noise * random.normal()));
        }
    }
};

double deviation(const std::vector<float> &a, const std::vector<float> &b)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::pow(static_cast<double>(a[i] - b[i]), 2.0);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

bool isZero(const std::vector<float> &values)
{
    return std::ranges::all_of(values, [](float value) { return value == 0.0f; });
}

} // namespace

/// The level of noise from its cells, and what a series of levels tells.
class tst_levels : public QObject
{
    Q_OBJECT

private slots:
    void mediansOfExponentials();
    void truncatedMeanOfExponentials();
    void aWalkIsFollowed();
    void noiseIsNoWalk();
    void stepsAndClicksAreNoWalk();
    void whatIsSudden();
};

void tst_levels::mediansOfExponentials()
{
    QCOMPARE(medianMean(1), 1.0);
    QCOMPARE(medianMean(2), 0.5);             // the smaller of two
    QCOMPARE(medianMean(3), 1.0 / 3 + 1.0 / 2);
    QVERIFY(std::abs(medianMean(100001) - std::log(2.0)) < 1e-5);
    std::vector<float> four{4.0f, 1.0f, 3.0f, 2.0f};
    QCOMPARE(medianOf(four), 2.0f);
}

void tst_levels::truncatedMeanOfExponentials()
{
    Random random(32, 1);
    std::vector<float> cells(20000);
    for (float &cell : cells)
        cell = static_cast<float>(3.0 * random.exponential());
    const float mean = truncatedMean(cells, 3.0f);
    QVERIFY2(std::abs(mean / 3.0f - 1.0f) < 5.0f * 1.1f / std::sqrt(20000.0f), qPrintable(QString::number(mean)));
    // From a guess a tenth away it comes to the same within a three-hundredth.
    for (float guess : {2.7f, 3.3f})
        QVERIFY2(std::abs(truncatedMean(cells, guess) / mean - 1.0f) < 0.0033f, qPrintable(QString::number(truncatedMean(cells, guess))));
    // However strong, twenty lines of 20000 cells do nothing to it.
    for (std::size_t i = 0; i < 20; ++i)
        cells[1000 * i] = 1e20f;
    QVERIFY(std::abs(truncatedMean(cells, 3.0f) / mean - 1.0f) < 0.003f);
    QCOMPARE(truncatedMean({}, 1.0f), 1.0f);
}

void tst_levels::aWalkIsFollowed()
{
    // Steps of a quarter of the noise: the best smoother leaves √(q·r)/2 of variance, a third of the noise's deviation.
    const Walk w(2000, 0.25, 1.0, 1);
    const double left = deviation(slowPart(w.series), w.walk);
    QVERIFY2(left > 0.25 && left < 0.45, qPrintable(QString::number(left)));
}

void tst_levels::noiseIsNoWalk()
{
    QVERIFY(isZero(slowPart(Walk(2000, 0.0, 1.0, 2).series)));
    QVERIFY(isZero(slowPart(Walk(40, 1.0, 1.0, 3).series))); // too short to tell
    QVERIFY(slowPart({}).empty());
}

void tst_levels::stepsAndClicksAreNoWalk()
{
    Walk w(2000, 0.0, 1.0, 4);
    for (std::size_t i = 700; i < 1400; ++i)
        w.series[i] += 30.0f;
    for (std::size_t i = 0; i < 2000; i += 97)
        w.series[i] += 50.0f;
    QVERIFY(isZero(slowPart(w.series)));
}

void tst_levels::whatIsSudden()
{
    Walk w(2000, 0.0, 1.0, 5);
    for (std::size_t i = 700; i < 1400; ++i)
        w.series[i] += 30.0f;
    w.series[100] = 50.0f; // one value of seven is no level
    const std::vector<float> sudden = suddenPart(w.series, 1.0, 2.0);
    QCOMPARE(sudden[100], 0.0f);
    for (std::size_t i = 700; i < 1400; ++i)
        QVERIFY(std::abs(sudden[i] - 30.0f) < 5.0f * 1.25f / std::sqrt(7.0f));
    // Of white noise next to nothing: 5 % of the medians lie beyond two deviations, and those hardly count.
    const double left = deviation(std::vector<float>(sudden.begin(), sudden.begin() + 690), std::vector<float>(690, 0.0f));
    QVERIFY2(left < 0.25, qPrintable(QString::number(left)));
    // Asked to be surer, it takes nothing for a change that is none, and the change itself as before.
    const std::vector<float> sure = suddenPart(w.series, 1.0, 4.5);
    QVERIFY(std::all_of(sure.begin(), sure.begin() + 690, [](float value) { return value == 0.0f; }));
    QVERIFY(std::equal(sure.begin() + 700, sure.begin() + 1400, sudden.begin() + 700));
}

QTEST_APPLESS_MAIN(tst_levels)
#include "tst_levels.moc"
