#include "base/json.h"
#include "calibrate/CalibrationRequest.h"
#include "calibrate/CalibrationStore.h"
#include "calibrate/calibrate.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>

using namespace faintline;

namespace {

std::shared_ptr<const Calibration> calibrationIn(const ShippedCalibration &shipped)
{
    return CalibrationStore::fromText(shipped.text, std::string(shipped.key));
}

/// A fifth of the noise.
CalibrationEffort smallEffort()
{
    CalibrationEffort effort = effortOf(CalibrationDepth::Refined);
    effort.cellFrames *= 0.2;
    effort.ofIndependentCells = 0.2;
    return effort;
}

/// Three of the day, or all in the long run.
std::vector<ShippedCalibration> chosen()
{
    std::vector<ShippedCalibration> all(shippedCalibrations().begin(), shippedCalibrations().end());
    if (test::isLong())
        return all;
    std::mt19937 random{std::uint32_t(QDate::currentDate().toJulianDay())};
    std::shuffle(all.begin(), all.end(), random);
    all.resize(std::min<std::size_t>(3, all.size()));
    return all;
}

AnalysisSettings withLaw(AnalysisSettings settings, const ModelSettings &law)
{
    settings.model = law;
    return settings;
}

AnalysisSettings live(AnalysisSettings settings)
{
    settings.noise.causal = true;
    return settings;
}

} // namespace

/// Calibrations that are part of the program: whole, enough for a first start, and what a simulation gives today.
class tst_shippedCalibrations : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { qputenv("FAINTLINE_CACHE", "off"); }

    void everyFileIsUsed()
    {
        const QDir folder(QStringLiteral(FAINTLINE_SOURCE_DIR "/resources/calibrations"));
        QCOMPARE(std::ssize(shippedCalibrations()), folder.entryList({"*.json"}).size());
        for (const ShippedCalibration &shipped : shippedCalibrations()) {
            const std::string key(shipped.key);
            const auto calibration = calibrationIn(shipped);
            QVERIFY2(calibration && !calibration->isFirstEstimate, shipped.name.data());
            const CalibrationRequest request = requestOf(key);
            QCOMPARE(request.key(), key);
            if (request.bins > 0) // starts from the wide one
                QVERIFY2(knownCalibration(request.settings), shipped.name.data());
            QVERIFY(*CalibrationStore({}).load(key) == *calibration);
        }
    }

    void firstDetectionsMakeNoCalibration_data()
    {
        QTest::addColumn<AnalysisSettings>("settings");
        QTest::addColumn<Index>("bins"); // of a narrow band
        for (const char *name : {"lines", "strong", "billon", "steady", "whistles"}) {
            const AnalysisSettings settings = preset(name).settings;
            QTest::newRow(name) << settings << Index(2000);
            QTest::addRow("%s, narrow", name) << settings << Index(100);
            QTest::addRow("%s, live", name) << live(settings) << Index(2000);
        }
        for (const char *name : {"lines", "strong"})
            for (const Index bins : {2000, 500, 100}) // in a shorter window
                QTest::addRow("%s, %d fast", name, int(bins)) << withLaw(preset(name).settings, laws::glide()) << bins;
    }

    void firstDetectionsMakeNoCalibration()
    {
        QFETCH(AnalysisSettings, settings);
        QFETCH(Index, bins);
        const std::clock_t begin = std::clock();
        QVERIFY(calibrateBand(settings, bins));
        QVERIFY(double(std::clock() - begin) / CLOCKS_PER_SEC < 0.5); // the cheapest simulation takes seconds
    }

    void agreeWithASimulationOfToday_data()
    {
        QTest::addColumn<std::string>("key");
        for (const ShippedCalibration &shipped : chosen())
            QTest::newRow(std::string(shipped.name).c_str()) << std::string(shipped.key);
    }

    // Within the intervals that both state. Equal seeds and a smaller part of the noise, so that the outcome is the same
    // every time, until what is simulated changes.
    void agreeWithASimulationOfToday()
    {
        QFETCH(std::string, key);
        const auto shipped = CalibrationStore({}).load(key);
        // Of a path that is never reset few excursions end, so that a fifth of the noise has too few of them.
        const bool isReset = shipped->continuedFraction < 0.9;
        const auto today =
            makeCalibration(requestOf(key), isReset ? smallEffort() : effortOf(CalibrationDepth::Refined));
        QVERIFY2(std::abs(today->lnK - shipped->lnK) < 2e-3,
                 qPrintable(QString("ln K %1, shipped %2").arg(today->lnK).arg(shipped->lnK)));
        for (const double p : {0.1, 1e-3}) {
            const double ratio = today->exceedanceAt(shipped->thresholdForPfa(p)) / p;
            QVERIFY2(std::abs(std::log(ratio)) < 0.15, qPrintable(QString("P %1: %2 times").arg(p).arg(ratio)));
        }
        for (const double rate : {1e-6, 1e-8}) {
            const double level = shipped->thresholdForEventRate(rate);
            const double ratio = today->eventRateAt(level) / rate;
            const double within = shipped->rateUncertaintyAt(level) * today->rateUncertaintyAt(level);
            const QString said =
                QString("at a rate of %1: %2 times, known to a factor of %3").arg(rate).arg(ratio).arg(within);
            QVERIFY2(std::abs(std::log(ratio)) < std::log(within), qPrintable(said));
        }
    }
};

FAINTLINE_TEST(tst_shippedCalibrations)
#include "tst_shippedCalibrations.moc"
