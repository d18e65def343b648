#include "calibrate/falseAlarmWords.h"
#include "support/test.h"

using namespace faintline;

/// A rate of false alarms as it stands beside the threshold.
class tst_falseAlarmWords : public QObject
{
    Q_OBJECT

private slots:
    void words_data()
    {
        QTest::addColumn<double>("perHour");
        QTest::addColumn<double>("factor");
        QTest::addColumn<QString>("expected");
        QTest::newRow("one per hour") << 1.0 << 1.25 << "one in 1 h (0.8 to 1.2)";
        QTest::newRow("many") << 25.0 << 1.25 << "25 per hour (20 to 31)";
        QTest::newRow("hours") << 0.9 << 1.3 << "one in 1.1 h (0.85 to 1.4)";
        QTest::newRow("days") << 0.01 << 1.3 << "one in 4.2 days (3.2 to 5.4)";
        QTest::newRow("years") << 1e-5 << 1.5 << "one in 11 years (7.6 to 17)";
        QTest::newRow("never") << 0.0 << 1.5 << "none";
    }

    void words()
    {
        QFETCH(double, perHour);
        QFETCH(double, factor);
        QFETCH(QString, expected);
        QCOMPARE(QString::fromStdString(falseAlarmWords(perHour, factor)), expected);
    }
};

FAINTLINE_TEST(tst_falseAlarmWords)
#include "tst_falseAlarmWords.moc"
