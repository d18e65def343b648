#include "analyse/analyse.h"
#include "calibrate/CalibrationRequest.h"
#include "calibrate/calibrate.h"
#include "scene/SimulatedRecording.h"
#include "support/test.h"

using namespace faintline;

/// False alarms of narrow bands, whose ends paths run off.
class tst_bandCalibration : public QObject
{
    Q_OBJECT

private slots:
    // 30 Hz of 500 in windows of a quarter of a second: 15 bins. Scaled from a wide band 0.4 of the order came, at one an
    // hour 0.26.
    void aNarrowBandKeepsItsOrder()
    {
        LineScene scene{.sampleRateHz = 1000.0, .durationSeconds = 5.0 * 3600.0};
        scene.noise.deviation = 1.0;
        scene.seed = 14;
        AnalysisSettings settings;
        settings.spectrogram.windowSeconds = 0.25;
        settings.selection.lowHz = 100.0;
        settings.selection.highHz = 130.0;
        settings.decide.falseAlarmsPerHour = 10.0;
        const auto analysis = analyse(std::make_shared<SimulatedRecording>(scene), settings);
        QVERIFY(analysis->grid().size() < 20);
        const double ratio = double(analysis->tracks.size()) / 50.0;
        QVERIFY2(ratio > 0.7 && ratio < 1.8, qPrintable(QString::number(ratio))); // 50 events: ± 0.3 by chance
    }

    void theWiderTheLessIsLost()
    {
        const AnalysisSettings settings;
        const auto wide = calibrate(settings);
        const double nats = wide->thresholdForEventRate(1e-6);
        double before = 0.0;
        for (const Index bins : {15, 130, 255}) {
            const double left = calibrateBand(settings, bins)->eventRateAt(nats) / wide->eventRateAt(nats);
            QVERIFY2(left > before && left < 1.0, qPrintable(QString("%1 bins: %2").arg(bins).arg(left)));
            before = left;
        }
        QVERIFY(before > 0.9);
        QVERIFY(*calibrateBand(settings, 256) == *wide);
    }

    // 31 bins are served by 23, as far from a simulated width as can be: against a simulation of their own.
    void oneSimulationServesManyWidths()
    {
        const AnalysisSettings settings;
        const auto served = calibrateBand(settings, 31);
        const auto own = makeCalibration({dimensionless(settings), CalibrationDepth::Refined, 31},
                                         effortOf(CalibrationDepth::Refined));
        const auto wide = calibrate(settings);
        for (const double rate : {1e-6, 1e-8}) {
            const double level = wide->thresholdForEventRate(rate);
            const double left = served->eventRateAt(level) / rate;
            const double ratio = served->eventRateAt(level) / own->eventRateAt(level);
            const QString said = QString("at %1: %2 is left, %3 of what was simulated").arg(rate).arg(left).arg(ratio);
            QVERIFY2(left < 0.8, qPrintable(said)); // the ends matter
            QVERIFY2(ratio > 0.8 && ratio < 1.25, qPrintable(said));
        }
    }

    void steadyLinesLoseNothing()
    {
        AnalysisSettings settings;
        settings.model = laws::steady();
        QVERIFY(*calibrateBand(settings, 15) == *calibrate(settings));
    }
};

FAINTLINE_TEST(tst_bandCalibration)
#include "tst_bandCalibration.moc"
