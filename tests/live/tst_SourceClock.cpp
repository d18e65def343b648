#include "live/Hearing.h"
#include "support/test.h"

#include "base/Random.h"
#include "support/errors.h"

#include <cmath>
#include <vector>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr double clockRate = 48'000.0;

/// Deliveries of a clock that is so many ppm slow, each late by up to a twentieth of a second, some by up to one.
std::vector<SourceClock::Departure> told(SourceClock &clock, double ppmSlow, double hours)
{
    Random random(1, 2);
    std::vector<SourceClock::Departure> all;
    double now = 1000.0;
    for (Index counted = 4800; double(counted) < 3600.0 * hours * clockRate; counted += 4800) {
        const double made = 1000.0 + double(counted) / clockRate / (1.0 - 1e-6 * ppmSlow);
        const double late = random.uniform() < 0.01 ? random.uniform() : 0.05 * random.uniform();
        now = std::max(now, made + late); // in the order they were made
        if (const auto departure = clock.note(counted, now))
            all.push_back(*departure);
    }
    return all;
}

} // namespace

/// A source whose clock goes wrong is told of, with how wrong; one whose deliveries are late is not.
class tst_SourceClock : public QObject
{
    Q_OBJECT

private slots:
    void departs_data()
    {
        QTest::addColumn<double>("ppm");
        QTest::newRow("slow") << 80.0;
        QTest::newRow("fast") << -80.0;
        QTest::newRow("very slow") << 5000.0;
        QTest::newRow("a little fast") << -15.0;
    }

    // At 0.1 s, 0.2 s, 0.4 s …
    void departs()
    {
        QFETCH(double, ppm);
        SourceClock clock(clockRate);
        const std::vector<SourceClock::Departure> all = told(clock, ppm, 3.0);
        QCOMPARE(std::ssize(all), Index(1 + std::floor(std::log2(10'800.0 * std::abs(ppm) * 1e-6 / 0.1))));
        double expected = 0.1;
        for (const SourceClock::Departure &departure : all) {
            const double seconds = double(departure.samples) / clockRate;
            QVERIFY2(std::abs(seconds) >= expected && std::abs(seconds) < expected + 0.02 + 11e-6 * std::abs(ppm),
                     qPrintable(QString::number(seconds)));
            // The least late of a hundred deliveries is half a millisecond late in the mean, and few are later than 4 ms.
            QVERIFY2(std::abs(departure.ppm / ppm - 1.0) < 0.008 / std::abs(seconds) + 0.001,
                     qPrintable(QString::number(departure.ppm)));
            expected *= 2.0;
        }
        QVERIFY(contains(all.front().words, ppm > 0.0 ? " ppm slow: in " : " ppm fast: in "));
        QVERIFY(contains(all.front().words, ppm > 0.0 ? "behind this machine's" : "ahead of this machine's"));
    }

    void lateDeliveries()
    {
        SourceClock clock(clockRate);
        QVERIFY(told(clock, 0.0, 24.0).empty());
    }

    void beginsAnew()
    {
        SourceClock clock(clockRate);
        QVERIFY(!told(clock, 500.0, 0.1).empty());
        clock.restart();
        QVERIFY(told(clock, 0.0, 0.1).empty());
    }
};

FAINTLINE_TEST(tst_SourceClock)
#include "tst_SourceClock.moc"
