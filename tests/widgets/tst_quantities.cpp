#include "support/test.h"
#include "widgets/base/quantities.h"

#include "widgets/base/scaleTicks.h"

#include <cmath>
#include <limits>

using namespace faintline;

/// Numbers as people read them, and ticks where they expect them.
class tst_quantities : public QObject
{
    Q_OBJECT

private slots:
    void numbers()
    {
        QCOMPARE(numberText(1.26, 1), QString("1.3"));
        QCOMPARE(numberText(-3.0, 0), QString("−3"));
        QCOMPARE(numberText(-0.001, 1), QString("0.0"));
        QCOMPARE(numberText(std::numeric_limits<double>::infinity(), 1), QString("∞"));
        QCOMPARE(numberText(std::nan(""), 1), QString("–"));
        QCOMPARE(decimalsFor(1.0), 0);
        QCOMPARE(decimalsFor(0.1), 1);
        QCOMPARE(decimalsFor(0.02), 2);
        QCOMPARE(decimalsFor(50.0), 0);
        QCOMPARE(decimalsFor(0.0), 0);
    }

    void times()
    {
        QCOMPARE(secondsText(12.345, 0.01), QString("12.35 s"));
        QCOMPARE(secondsText(599.0, 1.0), QString("599 s"));
        QCOMPARE(secondsText(3750.5, 0.1), QString("1:02:30.5"));
        QCOMPARE(clockText(59.999, 1, false), QString("1:00.0")); // carried, not 0:60.0
        QCOMPARE(clockText(3599.99, 0, true), QString("1:00:00"));
        QCOMPARE(clockText(-61.0, 0, false), QString("−1:01"));
        QCOMPARE(clockText(0.0, 0, true), QString("0:00:00"));
    }

    void frequencies()
    {
        QCOMPARE(hertzText(440.0, 0.1), QString("440.0 Hz"));
        QCOMPARE(hertzText(14095.6, 0.1), QString("14.0956 kHz"));
        QCOMPARE(hertzText(14.0740001e6, 1.0), QString("14.074000 MHz"));
        QCOMPARE(hertzText(-250.0, 1.0), QString("−250 Hz"));
    }

    void powers()
    {
        QCOMPARE(powerText(3e-7), QString("3·10⁻⁷"));
        QCOMPARE(powerText(2.54e-7), QString("2.5·10⁻⁷"));
        QCOMPARE(powerText(0.25), QString("0.25"));
        QCOMPARE(powerText(1.0), QString("1"));
        QCOMPARE(powerText(0.0), QString("0"));
        QCOMPARE(powerText(-0.0125, 3), QString("−0.0125"));
        QCOMPARE(powerText(6.02e23, 3), QString("6.02·10²³"));
        QCOMPARE(powerText(9.999e-7, 2), QString("1·10⁻⁶"));
        QCOMPARE(powerOfTenText(-12), QString("10⁻¹²"));
    }

    void timeTicks()
    {
        const auto majors = [](double low, double high, int count) {
            return timeScaleDiv({low, high}, count).ticks(QwtScaleDiv::MajorTick);
        };
        QCOMPARE(majors(0.0, 3600.0, 6), (QList<double>{0, 600, 1200, 1800, 2400, 3000, 3600}));
        QCOMPARE(majors(0.0, 150.0, 5), (QList<double>{0, 30, 60, 90, 120, 150}));
        const QList<double> fine = majors(10.1, 10.9, 4), expected{10.2, 10.4, 10.6, 10.8};
        QCOMPARE(fine.size(), expected.size());
        for (int i = 0; i < fine.size(); ++i)
            QVERIFY(std::abs(fine[i] - expected[i]) < 1e-9);
        QCOMPARE(majors(0.0, 86400.0, 4), (QList<double>{0, 21600, 43200, 64800, 86400}));
        QCOMPARE(majorStep(timeScaleDiv({0.0, 7200.0}, 4)), 1800.0);
        // Minor ticks lie between the major ones, none on top of another.
        const QwtScaleDiv div = timeScaleDiv({0.0, 120.0}, 4);
        for (const double minor : div.ticks(QwtScaleDiv::MinorTick))
            QVERIFY(!div.ticks(QwtScaleDiv::MajorTick).contains(minor));
    }
};

FAINTLINE_WINDOW_TEST(tst_quantities)
#include "tst_quantities.moc"
