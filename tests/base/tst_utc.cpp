#include "base/utc.h"
#include "support/test.h"

using namespace faintline;

/// Times of day: ISO 8601 both ways.
class tst_utc : public QObject
{
    Q_OBJECT

private slots:
    void parses_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<double>("seconds");
        QTest::newRow("epoch") << "1970-01-01T00:00:00Z" << 0.0;
        QTest::newRow("plain") << "2024-07-26T00:00:00Z" << 1721952000.0;
        QTest::newRow("fraction") << "2024-07-26T00:00:00.25Z" << 1721952000.25;
        QTest::newRow("long fraction") << "2024-07-26T00:00:00.250000000000000000000001Z" << 1721952000.25;
        QTest::newRow("comma, blank, no zone") << "2024-07-26 00:00:00,5" << 1721952000.5;
        QTest::newRow("east") << "2024-07-26T02:00:00+02:00" << 1721952000.0;
        QTest::newRow("west") << "2024-07-25T18:30:00-0530" << 1721952000.0;
        QTest::newRow("hours only") << "2024-07-26T02:00:00+02" << 1721952000.0;
        QTest::newRow("basic form") << "20240726T000000Z" << 1721952000.0;
        QTest::newRow("leap day") << "2024-02-29T23:59:59Z" << 1709251199.0;
        QTest::newRow("leap second") << "2016-12-31T23:59:60Z" << 1483228800.0;
        QTest::newRow("before 1970") << "1969-12-31T23:59:59.5Z" << -0.5;
    }

    void parses()
    {
        QFETCH(QString, text);
        QFETCH(double, seconds);
        QCOMPARE(parseUtc(text.toStdString()), std::optional(seconds));
    }

    void refuses()
    {
        for (const char *text :
             {"", "now", "2024", "2024-07-26", "2024-07-26T", "2024-07-26T00:00", "2024-13-01T00:00:00Z",
              "2023-02-29T00:00:00Z", "2024-07-26T24:00:00Z", "2024-07-26T00:60:00Z", "2024-07-26T00:00:61Z",
              "2024-07-26T00:00:00.Z", "2024-07-26T00:00:00X", "2024-07-26T00:00:00+0", "-024-07-26T00:00:00Z",
              "2024-07-26T00:00:00Z and more"})
            QVERIFY2(!parseUtc(text), text);
    }

    void formats()
    {
        QCOMPARE(formatUtc(0.0), std::string("1970-01-01T00:00:00Z"));
        QCOMPARE(formatUtc(1721952000.25), std::string("2024-07-26T00:00:00.25Z"));
        QCOMPARE(formatUtc(1721952000.9999999), std::string("2024-07-26T00:00:01Z"));
        QCOMPARE(formatUtc(-0.5), std::string("1969-12-31T23:59:59.5Z"));
        QCOMPARE(formatUtc(std::nan("")), std::string());
        for (double seconds = -1e10; seconds < 1e10; seconds += 12345678.125)
            QCOMPARE(parseUtc(formatUtc(seconds)), std::optional(seconds));
    }

    void impossibleDates()
    {
        QVERIFY(!unixSeconds(2024, -1, 1));
        QVERIFY(!unixSeconds(2024, 1, -1));
        QVERIFY(!unixSeconds(2024, 4, 31));
        QVERIFY(!unixSeconds(2024, 1, 1, {0, 0, std::nan("")}));
        QCOMPARE(unixSeconds(2000, 3, 1), std::optional(951868800.0));
    }
};

FAINTLINE_TEST(tst_utc)
#include "tst_utc.moc"
