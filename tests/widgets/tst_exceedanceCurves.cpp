#include "support/test.h"
#include "widgets/plot/exceedanceCurves.h"

#include <cmath>

using namespace faintline;

/// The points of the threshold's plot, from counts and calibrations that can be checked by eye.
class tst_exceedanceCurves : public QObject
{
    Q_OBJECT

private slots:
    void recording()
    {
        const std::vector<double> counts{0, 2, 1, 1, 0};
        const QPolygonF curve = recordedCurve(counts);
        QCOMPARE(curve, QPolygonF({{-4.0, 0.0}, {-3.75, 0.0}, {-3.5, std::log10(0.5)}, {-3.25, std::log10(0.25)}}));
        const QList<QwtIntervalSample> bars = recordedCells(counts, -3.25);
        QCOMPARE(bars, QList<QwtIntervalSample>({{std::log10(2.0), -3.75, -3.5}, {0.0, -3.5, -3.25}}));
        QVERIFY(recordedCurve({}).isEmpty() && recordedCells({}, 0.0).isEmpty());
    }

    void logarithms()
    {
        QCOMPARE(logarithmic({{1.0, 0.01}, {2.0, 0.0}}), QPolygonF({{1.0, -2.0}, {2.0, smallestExponent - 6.0}}));
    }

    void onlyWhatWasCountedIsSimulated()
    {
        Calibration calibration;
        calibration.above = {0.5, 0.1, 5e-5, 0.0}; // from the third on the tail counts
        calibration.eventRate = 1e-3;
        QCOMPARE(simulatedCurve(calibration), QPolygonF({{0.0, std::log10(0.5)}, {1.0, std::log10(0.1)}}));
    }

    void theSpanHoldsTheThreshold()
    {
        for (const double threshold : {-50.0, 0.0, 12.0, 29.0, 1000.0}) {
            const Span span = exceedanceSpan(nullptr, {}, threshold);
            QVERIFY(span.contains(threshold) && span.low <= 0.0 && span.high >= 30.0);
        }
    }

    /// Cells far above the noise widen the span, but the noise keeps half of it.
    void theSpanReachesToSignals()
    {
        Calibration calibration;
        calibration.levelStep = 10.0;
        calibration.above = {0.5, 1e-6};
        calibration.tailSlope = 1.0;
        QCOMPARE(exceedanceSpan(&calibration, {}, 5.0).high, 18.0);
        std::vector<double> counts(400, 0.0);
        counts[100] = 1.0; // up to 21.25 nat
        QCOMPARE(exceedanceSpan(&calibration, counts, 5.0).high, 21.25);
        counts[399] = 1.0; // up to 96 nat
        QCOMPARE(exceedanceSpan(&calibration, counts, 5.0).high, 36.0);
    }
};

FAINTLINE_TEST(tst_exceedanceCurves)
#include "tst_exceedanceCurves.moc"
