#include "analyse/analyse.h"
#include "calibrate/CalibrationRequest.h"
#include "calibrate/calibrate.h"
#include "scene/SimulatedRecording.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;

/// A calibration made quickly, beside the refined one.
class tst_firstEstimate : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { qputenv("FAINTLINE_CACHE", "off"); } // a refined one that was kept would come first

    void withinAFactor_data()
    {
        QTest::addColumn<QString>("preset");
        for (const char *name : {"lines", "steady"})
            QTest::newRow(name) << QString(name);
    }

    void withinAFactor()
    {
        QFETCH(QString, preset);
        const AnalysisSettings settings = faintline::preset(preset.toStdString()).settings;
        CalibrationRequest request{dimensionless(settings), CalibrationDepth::FirstEstimate};
        const auto first = makeCalibration(request, effortOf(request.depth)); // calibrate() knows better: it is shipped
        const auto refined = calibrate(settings);
        QVERIFY(first->isFirstEstimate && !refined->isFirstEstimate);
        for (const double rate : {1e-6, 1e-7}) { // 14 and 1.4 an hour in a kilohertz of I/Q
            const double ratio = refined->eventRateAt(first->thresholdForEventRate(rate)) / rate;
            QVERIFY2(std::abs(std::log(ratio)) < std::log(1.5), qPrintable(QString("%1 at %2").arg(ratio).arg(rate)));
        }
    }

    void nothingElseDiffers()
    {
        LineScene scene{.sampleRateHz = 400.0, .durationSeconds = 60.0};
        scene.noise.deviation = 1.0;
        const auto recording = std::make_shared<SimulatedRecording>(scene);
        AnalysisSettings settings;
        settings.model.snr = 0.7; // of no shipped calibration
        settings.spectrogram.windowSeconds = 0.5;
        settings.decide.by = DecideSettings::By::PfaPerCell;
        settings.decide.pfaPerCell = 1e-3;
        const auto first = analyse(recording, settings, {.calibration = CalibrationDepth::FirstEstimate});
        const auto refined = analyse(recording, settings, {.previous = first.get()});
        const auto alone = analyse(recording, settings);
        QVERIFY(first->calibration->isFirstEstimate && !refined->calibration->isFirstEstimate);
        QCOMPARE(first->calibration->lnK, alone->calibration->lnK);
        QCOMPARE(first->threshold, alone->threshold); // of a probability that was simulated
        QCOMPARE(refined->tracks.size(), alone->tracks.size());
        QCOMPARE(refined->threshold, alone->threshold);
    }
};

FAINTLINE_TEST(tst_firstEstimate)
#include "tst_firstEstimate.moc"
