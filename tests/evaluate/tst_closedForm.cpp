#include "calibrate/calibrate.h"
#include "evaluate/theory/theory.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;

namespace {

/// The largest ratio, of logarithms' difference, between the closed form and the simulated calibration where that
/// speaks for itself.
double largestGap(const AnalysisSettings &settings)
{
    const auto calibration = calibrate(settings, {}, CalibrationDepth::FirstEstimate);
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

    void ofABoxByEye()
    {
        PeakPyramid picture({"time", "s", 0.0, 1.0, 20, false}, 4, ByteScale(ByteScale::Kind::ScoreNats));
        for (int frame = 0; frame < 20; ++frame)
            picture.append(std::vector<float>{0.0f, 1.0f, 2.0f, 30.0f});
        picture.finish();
        // Of columns 0 … 2: all above -1, two of three above ½, one of three above 1½, none above 2½.
        const auto at = [](const std::vector<ExceedancePoint> &points, double level) {
            double found = 0.0;
            for (const ExceedancePoint &point : points)
                if (std::abs(point.level - level) < 0.2)
                    found = point.probability;
            return found;
        };
        const auto points = boxExceedance(picture, 0, 20, 0, 3);
        QCOMPARE(at(points, -1.0), 1.0);
        QCOMPARE(at(points, 0.5), 2.0 / 3.0);
        QCOMPARE(at(points, 1.5), 1.0 / 3.0);
        QVERIFY(points.back().level < 2.0);
        QVERIFY(boxExceedance(picture, 5, 5, 0, 3).empty());
        QVERIFY(boxExceedance(picture, 0, 9, 2, 3).empty()); // nine cells say nothing
        QCOMPARE(boxExceedance(picture, -7, 900, 0, 900).size(), boxExceedance(picture, 0, 20, 0, 4).size());
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

FAINTLINE_TEST(tst_closedForm)
#include "tst_closedForm.moc"
