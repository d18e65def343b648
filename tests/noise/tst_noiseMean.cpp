#include "noise/noiseMean.h"
#include "support/test.h"

#include "support/frames.h"

#include <limits>
#include <random>

using namespace faintline;

class tst_noiseMean : public QObject
{
    Q_OBJECT

private slots:
    void ofExponentialNoise_data()
    {
        QTest::addColumn<double>("mean");
        QTest::addColumn<bool>("isTold");
        QTest::addRow("1") << 1.0 << false;
        QTest::addRow("5") << 5.0 << true;
        QTest::addRow("1e-6") << 1e-6 << true;
    }

    void ofExponentialNoise()
    {
        QFETCH(double, mean);
        QFETCH(bool, isTold);
        std::mt19937 random(1);
        std::exponential_distribution<double> power(1.0 / mean);
        std::vector<float> values(200 * 100);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = i % 7 == 0    ? std::numeric_limits<float>::quiet_NaN() // not observed
                        : i % 50 == 3 ? 1000.0f * float(mean)                   // a signal
                                      : float(power(random));
        const FrameArray made = *test::framesOf(100, values);
        QVERIFY2(std::abs(noiseMeanOf(made) / mean - 1.0) < 0.08, qPrintable(QString::number(noiseMeanOf(made))));
        QCOMPARE(!noiseMeanWarning(made).empty(), isTold);
        if (mean == 5.0)
            QVERIFY(noiseMeanWarning(made).starts_with("the mean of the noise is about 5, not 1")
                    || noiseMeanWarning(made).starts_with("the mean of the noise is about 5."));
    }

    void ofNothing()
    {
        QCOMPARE(noiseMeanOf(*test::framesOf(3, std::vector<float>(6, std::numeric_limits<float>::quiet_NaN()))), 1.0);
    }
};

FAINTLINE_TEST(tst_noiseMean)
#include "tst_noiseMean.moc"
