#include "evaluate/closedForm.h"
#include "evaluate/theory.h"

#include <QtTest>

#include <cmath>

using namespace faintline;

namespace {

    /// The largest ratio, of logarithms' difference, between the closed form and the simulated calibration where that speaks for itself.
    double largestGap(const AnalysisSettings &settings)
    {
        const auto calibration = calibrate(settings, {}, 4e6);
        double largest = 0.0;
        int compared = 0;
        for (const ExceedancePoint &point : closedFormExceedance(settings, *calibration)) {
            if (point.probability > 0.5 || point.probability < 2e-3)
                continue;
            ++compared;
            largest = std::max(largest, std::abs(std::log(calibration->exceedanceAt(point.level) / point.probability)));
        }
        return compared < 5 ? INFINITY : largest;
    }

    AnalysisSettings withoutOverlap()
    {
        AnalysisSettings settings;
        settings.spectrogram.stepsPerWindow = 1;
        settings.spectrogram.binsPerCell = 1;
        settings.spectrogram.window = WindowShape::Rectangular;
        return settings;
    }

} // namespace

/// Exceedance on noise where it is known, against the simulation that serves everything else.
class tst_closedForm : public QObject
{
    Q_OBJECT

private slots:
    void energy()
    {
        AnalysisSettings settings;
        settings.detector = EnergySettings{};
        const auto points = closedFormExceedance(settings, Calibration());
        QCOMPARE(points[4].level, 1.0);
        QCOMPARE(points[4].probability, std::exp(-1.0));
        QVERIFY(points.back().probability >= 1e-15);
        // The background is known to a per cent, the counts are in their thousands.
        QVERIFY2(largestGap(settings) < 0.1, qPrintable(QString::number(largestGap(settings))));
    }

    void integrator()
    {
        AnalysisSettings settings = withoutOverlap();
        IntegratorSettings integrator;
        integrator.durationWindows = 8.0;
        settings.detector = integrator;
        QVERIFY2(largestGap(settings) < 0.15, qPrintable(QString::number(largestGap(settings))));
        settings.spectrogram.stepsPerWindow = 2; // looks that overlap are not independent
        QVERIFY(closedFormExceedance(settings, Calibration()).empty());
    }

    void markov()
    {
        AnalysisSettings settings = withoutOverlap();
        settings.model.lowestSlope = settings.model.highestSlope = 0;
        settings.model.slopeChange = {1.0};
        settings.model.likelihood = LikelihoodKind::Linear;
        settings.detector = SmdSettings{SmdSettings::Reset::Fixed, -1.5};
        QVERIFY2(largestGap(settings) < 0.15, qPrintable(QString::number(largestGap(settings))));
        settings.model.highestSlope = 1;
        Calibration calibration;
        calibration.lnK = -1.5;
        QVERIFY(closedFormExceedance(settings, calibration).empty());
        QVERIFY(closedFormExceedance(AnalysisSettings(), calibration).empty());
    }
};

QTEST_GUILESS_MAIN(tst_closedForm)
#include "tst_closedForm.moc"
