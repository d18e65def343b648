#include "base/Random.h"
#include "detect/cellAveraging.h"
#include "support/test.h"

using namespace faintline;

/// Cells over the mean of their neighbours, and the evidence in them.
class tst_cellAveraging : public QObject
{
    Q_OBJECT

private slots:
    void byEye()
    {
        // Two neighbours: in the middle one on either side, at the ends the two nearest.
        std::vector<float> y{1, 2, 4, 6, 2};
        averageCells(y, 5, 2);
        QCOMPARE(y, (std::vector<float>{1.0f / 3.0f, 2.0f / 2.5f, 4.0f / 4.0f, 6.0f / 3.0f, 2.0f / 5.0f}));
    }

    void rowsDoNotMix()
    {
        std::vector<float> rows{1, 2, 4, 6, 2, 900, 700, 100, 300, 400};
        std::vector<float> first(rows.begin(), rows.begin() + 5);
        averageCells(rows, 5, 3);
        averageCells(first, 5, 3);
        QCOMPARE(std::vector<float>(rows.begin(), rows.begin() + 5), first);
    }

    void scaleDoesNotMatter()
    {
        Random random(1, 1);
        std::vector<float> y(64);
        random.exponentials(y);
        std::vector<float> louder = y;
        for (float &value : louder)
            value *= 1024.0f;
        averageCells(y, 32, 8);
        averageCells(louder, 32, 8);
        QCOMPARE(louder, y);
    }

    void silence()
    {
        std::vector<float> y(10, 0.0f);
        y[4] = 3.0f; // and one cell whose neighbours are silent
        averageCells(y, 10, 4);
        for (const float value : y)
            QVERIFY(value == 0.0f);
    }

    void evidenceIsExact()
    {
        // The density of a target's quotient over that of noise, by finite differences of the distributions (1 +
        // t/N(1+ρ))^{-N} and (1 + t/N)^{-N}.
        constexpr Index N = 16;
        constexpr double snr = 4.0;
        const auto tail = [](double t, double mean) { return std::pow(1.0 + t / (double(N) * mean), -double(N)); };
        for (const double t : {0.1, 1.0, 5.0, 40.0}) {
            constexpr double h = 1e-5;
            const double target = tail(t - h, 1.0 + snr) - tail(t + h, 1.0 + snr);
            const double noise = tail(t - h, 1.0) - tail(t + h, 1.0);
            std::vector<float> value{float(t)};
            correctAveraged(value, N, snr);
            const double lambda = double(value[0]) * snr / (1.0 + snr) - std::log1p(snr);
            QVERIFY(std::abs(lambda - std::log(target / noise)) < 1e-5 * (1.0 + std::abs(lambda)));
        }
    }
};

FAINTLINE_TEST(tst_cellAveraging)
#include "tst_cellAveraging.moc"
