#include "scene/Fluctuation.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>

using namespace faintline;

/// Powers drawn for Swerling's cases, against the tails of χ² laws with 2 and 4 degrees of freedom.
class tst_Fluctuation : public QObject
{
    Q_OBJECT

private slots:
    void powersHaveTheirLaw_data()
    {
        QTest::addColumn<int>("number");
        for (int number = 1; number <= 4; ++number)
            QTest::newRow(std::string(fluctuationNames[std::size_t(number)]).c_str()) << number;
    }

    void powersHaveTheirLaw()
    {
        QFETCH(int, number);
        const auto fluctuation = static_cast<Fluctuation>(number);
        QCOMPARE(changesFromFrameToFrame(fluctuation), number % 2 == 0);
        constexpr int draws = 100000;
        Random random(31, std::uint64_t(number));
        std::vector<double> powers(draws);
        for (double &power : powers)
            power = relativePower(fluctuation, random);
        double mean = 0.0;
        for (const double power : powers)
            mean += power / draws;
        const double variance = number <= 2 ? 1.0 : 0.5;
        QVERIFY2(std::abs(mean - 1.0) < 4.5 * std::sqrt(variance / draws), qPrintable(QString::number(mean)));
        for (const double level : {0.1, 0.5, 1.0, 2.0, 4.0}) {
            const double p = number <= 2 ? std::exp(-level) : (1.0 + 2.0 * level) * std::exp(-2.0 * level);
            const auto above =
                std::count_if(powers.begin(), powers.end(), [level](double power) { return power > level; });
            QVERIFY2(std::abs(double(above) / draws - p) < 4.5 * std::sqrt(p * (1.0 - p) / draws),
                     qPrintable(QString("above %1").arg(level)));
        }
    }

    void withoutFluctuationNothingIsDrawn()
    {
        Random random(31, 9);
        Random untouched(31, 9);
        QCOMPARE(relativePower(Fluctuation::None, random), 1.0);
        QCOMPARE(random.bits(), untouched.bits());
    }
};

FAINTLINE_TEST(tst_Fluctuation)
#include "tst_Fluctuation.moc"
