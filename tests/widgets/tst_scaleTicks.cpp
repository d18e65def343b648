#include "support/test.h"
#include "widgets/base/scaleTicks.h"

#include "widgets/plot/NumberScaleDraw.h"
#include "widgets/plot/PowerScaleDraw.h"
#include "widgets/plot/TimeScaleDraw.h"

#include <qwt_text.h>

#include <cmath>

using namespace faintline;

/// Where a scale has ticks, and what is written there.
class tst_scaleTicks : public QObject
{
    Q_OBJECT

private slots:
    void timeIsDividedRoundly_data()
    {
        QTest::addColumn<double>("width");
        QTest::addColumn<int>("most");
        QTest::addColumn<double>("step");
        QTest::newRow("milliseconds") << 0.01 << 5 << 0.002;
        QTest::newRow("seconds") << 9.0 << 5 << 2.0;
        QTest::newRow("15 s, not 20") << 60.0 << 5 << 15.0;
        QTest::newRow("minutes") << 600.0 << 6 << 120.0;
        QTest::newRow("quarters of an hour") << 3600.0 << 4 << 900.0;
        QTest::newRow("hours") << 43200.0 << 6 << 7200.0;
        QTest::newRow("days") << 10.0 * 86400.0 << 5 << 2.0 * 86400.0;
    }

    void timeIsDividedRoundly()
    {
        QFETCH(double, width);
        QFETCH(int, most);
        QFETCH(double, step);
        const double low = 0.3 * width;
        const QwtScaleDiv div = timeScaleDiv({low, low + width}, most);
        QVERIFY(std::abs(majorStep(div) - step) < 1e-9 * step);
        QVERIFY(major(div).size() <= most + 1);
        for (const double tick : major(div)) {
            QVERIFY(tick >= low * (1.0 - 1e-9) && tick <= (low + width) * (1.0 + 1e-9));
            QVERIFY(std::abs(tick / step - std::round(tick / step)) < 1e-6); // counted from 0, wherever one looks
        }
    }

    void twoNumbersWhereThereIsRoom()
    {
        for (const double low : {0.0, 0.7, 123.4})
            for (const double width : {0.3, 1.0, 1.9, 3.0}) // of 0.7 … 3.7, steps of 2 would leave one
                QVERIFY(major(linearScaleDiv({low, low + width}, 2)).size() >= 2);
        QVERIFY(!major(linearScaleDiv({2000.0, 4990.0}, 1)).isEmpty()); // room for one, though 5000 lies outside
        const QwtScaleDiv div = linearScaleDiv({0.7, 1.9}, 4);
        QCOMPARE(div.lowerBound(), 0.7); // the scale ends where the span does
        QCOMPARE(div.upperBound(), 1.9);
    }

    void decadesAreThinnedOut_data()
    {
        QTest::addColumn<double>("low");
        QTest::addColumn<double>("high");
        QTest::addColumn<int>("most");
        QTest::addColumn<QList<double>>("ticks");
        QTest::newRow("all") << -3.0 << 0.0 << 4 << QList<double>{-3, -2, -1, 0};
        QTest::newRow("every second") << -6.0 << 0.0 << 3 << QList<double>{-6, -4, -2, 0};
        QTest::newRow("every fourth") << -14.0 << -1.0 << 4 << QList<double>{-12, -8, -4};
        QTest::newRow("ends between") << -2.5 << 0.7 << 8 << QList<double>{-2, -1, 0};
        QTest::newRow("no room at all") << -3.0 << 0.0 << 0 << QList<double>{-3, 0};
    }

    void decadesAreThinnedOut()
    {
        QFETCH(double, low);
        QFETCH(double, high);
        QFETCH(int, most);
        QFETCH(QList<double>, ticks);
        const QwtScaleDiv div = decadeScaleDiv({low, high}, most);
        QCOMPARE(major(div), ticks);
        QCOMPARE(div.lowerBound(), low);
        QCOMPARE(div.upperBound(), high);
    }

    void digitsBetweenTheDecades()
    {
        const QwtScaleDiv div = digitScaleDiv({-1.5, 1.2});
        QCOMPARE(major(div), (QList<double>{-2, -1, 0, 1, 2}));
        const QList<double> minor = div.ticks(QwtScaleDiv::MinorTick);
        QCOMPARE(minor.size(), qsizetype(5 * 8));
        QVERIFY(std::abs(std::pow(10.0, minor.front()) - 0.02) < 1e-12);
    }

    void logarithmicTicks()
    {
        QCOMPARE(major(logarithmicScaleDiv({20.0, 3000.0}, 12)), (QList<double>{20, 50, 100, 200, 500, 1000, 2000}));
        QCOMPARE(major(logarithmicScaleDiv({20.0, 3000.0}, 5)), (QList<double>{30, 100, 300, 1000, 3000}));
        QCOMPARE(major(logarithmicScaleDiv({20.0, 3000.0}, 3)), (QList<double>{100, 1000}));
        QVERIFY(major(logarithmicScaleDiv({210.0, 290.0}, 5)).size() >= 3); // as on a linear scale
        QVERIFY(logarithmicScaleDiv({20.0, 3000.0}, 12).ticks(QwtScaleDiv::MinorTick).contains(700.0));
        NumberScaleDraw draw;
        draw.setLogarithmic(true);
        draw.setUnit(1000.0);
        draw.setScaleDiv(logarithmicScaleDiv({20.0, 30000.0}, 12));
        QCOMPARE(draw.label(20.0).text(), QString("0.02"));
        QCOMPARE(draw.label(20000.0).text(), QString("20"));
    }

    void ticksOfAnOrigin()
    {
        const double origin = 145.8e6;
        const QwtScaleDiv div = linearScaleDiv({-1300.0, 1300.0}, 4, origin);
        NumberScaleDraw draw;
        draw.setUnit(1e6);
        draw.setOrigin(origin);
        draw.setScaleDiv(div);
        QCOMPARE(div.lowerBound(), -1300.0);
        QCOMPARE(major(div).size(), qsizetype(3));
        QCOMPARE(draw.label(major(div)[0]).text(), QString("145.799"));
        QCOMPARE(draw.label(major(div)[2]).text(), QString("145.801"));
    }

    void secondsOrClock()
    {
        TimeScaleDraw draw;
        draw.setScaleDiv(timeScaleDiv({0.0, 2.0}, 4)); // half a second
        QCOMPARE(draw.label(1.5).text(), QString("1.5"));
        draw.setScaleDiv(timeScaleDiv({0.0, 7200.0}, 4));
        QCOMPARE(draw.label(3600.0).text(), QString("3600"));
        draw.setTimes({0.0, 7211.0}, {});
        QCOMPARE(draw.title(), "Time (h:min:s)");
        QVERIFY(draw.label(3600.0).text().contains(':'));
        // As wide as any: a 1 is narrower than other figures.
        QVERIFY(!draw.widestLabel({0.0, 7211.0}).contains('1'));
    }

    // Ticks are round in UTC, wherever the recording began; past midnight it is 0 o'clock.
    void timesOfDay()
    {
        constexpr double start = 1'700'000'000.25; // 2023-11-14T22:13:20.25Z
        const QwtScaleDiv div = timeScaleDiv({0.0, 60.0}, 6, start);
        QCOMPARE(major(div).size(), 6);
        TimeScaleDraw draw;
        draw.setTimes({0.0, 60.0}, start);
        QCOMPARE(draw.title(), "Time (UTC)");
        draw.setScaleDiv(div);
        QCOMPARE(draw.label(major(div).front()).text(), QStringLiteral("22:13:30"));
        QCOMPARE(draw.label(major(div).back()).text(), QStringLiteral("22:14:20"));
        QCOMPARE(draw.label(6399.75).text(), QStringLiteral("0:00:00"));
        QCOMPARE(draw.widestLabel({0.0, 60.0}).size(), 8);
    }

    void numbersInTheirUnit()
    {
        NumberScaleDraw draw;
        draw.setUnit(1000.0);
        draw.setScaleDiv(linearScaleDiv({0.0, 2000.0}, 4)); // half a kHz
        QCOMPARE(draw.label(1500.0).text(), QString("1.5"));
        QCOMPARE(draw.label(-500.0).text(), QString(QChar(0x2212)) + "0.5"); // a true minus
        QCOMPARE(draw.widestLabel({-2000.0, 1000.0}), QString(QChar(0x2212)) + "2.0");
    }

    void powersOfTen()
    {
        const PowerScaleDraw draw;
        QCOMPARE(draw.label(0.0).text(), QString("1"));
        QCOMPARE(draw.label(3.0).text(), QString("1000"));
        QVERIFY(draw.label(-5.0).text().startsWith("10"));
        QVERIFY(draw.label(0.5).text().isEmpty());
    }

private:
    static QList<double> major(const QwtScaleDiv &div) { return div.ticks(QwtScaleDiv::MajorTick); }
};

FAINTLINE_WINDOW_TEST(tst_scaleTicks)
#include "tst_scaleTicks.moc"
