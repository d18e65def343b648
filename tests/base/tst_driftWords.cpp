#include "base/driftWords.h"
#include "support/test.h"

#include <cmath>
#include <limits>

using namespace faintline;

/// Drifts with a unit that suits them.
class tst_driftWords : public QObject
{
    Q_OBJECT

private slots:
    void drifts_data()
    {
        QTest::addColumn<double>("hzPerSecond");
        QTest::addColumn<QString>("words");
        for (const auto &[drift, words] :
             std::initializer_list<std::pair<double, const char *>>{{5e-5, "50 µHz/s"},
                                                                    {-5e-5, "-50 µHz/s"},
                                                                    {1.23e-6, "1.2 µHz/s"},
                                                                    {1e-4, "0.1 mHz/s"},
                                                                    {0.0123, "12 mHz/s"},
                                                                    {0.1, "0.1 Hz/s"},
                                                                    {-3.14159, "-3.1 Hz/s"},
                                                                    {123.4, "123 Hz/s"},
                                                                    {9999.0, "9999 Hz/s"},
                                                                    {1e4, "10 kHz/s"},
                                                                    {2.5e6, "2500 kHz/s"},
                                                                    {0.0, "0 Hz/s"}})
            QTest::newRow(words) << drift << words;
    }

    void drifts()
    {
        QFETCH(double, hzPerSecond);
        QFETCH(QString, words);
        QCOMPARE(QString::fromStdString(driftWords(hzPerSecond)), words);
    }

    void unitsOfALargestDrift()
    {
        QCOMPARE(driftUnit(1e4).name, "kHz/s");
        QCOMPARE(driftUnit(std::nextafter(1e4, 0.0)).name, "Hz/s");
        QCOMPARE(driftUnit(std::nextafter(0.1, 0.0)).name, "mHz/s");
        QCOMPARE(driftUnit(std::nextafter(1e-4, 0.0)).name, "µHz/s");
        QCOMPARE(driftUnit(0.0).name, "Hz/s");
        QCOMPARE(driftUnit(std::nan("")).name, "Hz/s");
        QCOMPARE(driftUnit(std::numeric_limits<double>::infinity()).name, "kHz/s");
        for (const double drift : {1e-6, 1e-3, 1.0, 1e5}) // a unit's name and its size belong together
            QCOMPARE(driftUnit(drift).hzPerSecond, QByteArray(driftUnit(drift).name).startsWith("kHz")   ? 1e3
                                                   : QByteArray(driftUnit(drift).name).startsWith("mHz") ? 1e-3
                                                   : QByteArray(driftUnit(drift).name).startsWith("Hz")  ? 1.0
                                                                                                         : 1e-6);
    }
};

FAINTLINE_TEST(tst_driftWords)
#include "tst_driftWords.moc"
