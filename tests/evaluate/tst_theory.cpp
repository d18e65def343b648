#include "base/Interval.h"
#include "base/Random.h"
#include "calibrate/calibrate.h"
#include "detect/Integrator.h"
#include "detect/PofN.h"
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

class tst_theory : public QObject
{
    Q_OBJECT

private slots:
    void closedFormsThatAreKnown()
    {
        QVERIFY(std::abs(pfaOfMeanPower(3.0, 1) - std::exp(-3.0)) < 1e-15);
        QVERIFY(std::abs(pfaOfMeanPower(1.5, 2) - std::exp(-3.0) * 4.0) < 1e-15); // e^-x (1 + x), x = 3
        QVERIFY(std::abs(pfaOfMeanPower(thresholdOfMeanPower(1e-7, 20), 20) - 1e-7) < 1e-16);
        QVERIFY(std::abs(pdOfMeanPower(2.0, 5, 0.0) - pfaOfMeanPower(2.0, 5)) < 1e-15);
        QVERIFY(std::abs(pdOfPofN(3, 4, 0.5) - 5.0 / 16.0) < 1e-15);
    }

    void billonsParentheses()
    {
        // Table 1 prints the SNR that theory asks for to reach the Pd it measured, at P_f,out = 100/7500.
        const double pfa = 100.0 / (150.0 * 50.0);
        const double pd[]{0.53, 0.83, 0.93, 0.98};
        const double db[]{-6.1, -4.4, -3.7, -2.9};
        for (int i = 0; i < 4; ++i)
            for (const double off : {-0.06, 0.06}) // dB: its rounding, and that of Pd
                QCOMPARE(pdOfMeanPower(thresholdOfMeanPower(pfa, 100), 100, std::pow(10.0, 0.1 * (db[i] + off)))
                             > pd[i],
                         off > 0.0);
    }

    void integratorAgainstMarcumQ()
    {
        // Twelve points: looks × SNR; constant amplitude in complex noise, the detector itself.
        constexpr int trials = 20000;
        constexpr double pfa = 0.01;
        std::uint64_t stream = 0;
        for (const int looks : {1, 10, 100})
            for (const double factor : {2.0, 4.0, 6.0, 9.0}) {
                const double snr = factor / std::pow(looks, 0.65);
                const auto threshold = float(thresholdOfMeanPower(pfa, looks));
                const double pd = pdOfMeanPower(double(threshold), looks, snr);
                Random random(11, stream++);
                std::vector<float> noise(2 * trials);
                std::vector<float> y(trials);
                std::vector<float> mean(trials);
                Integrator detector(trials, IntegratorSettings::Shape::Boxcar, looks);
                for (int look = 0; look < looks; ++look) {
                    random.normals(noise, std::sqrt(0.5f));
                    for (std::size_t i = 0; i < y.size(); ++i) {
                        const float re = noise[2 * i] + float(std::sqrt(snr));
                        y[i] = re * re + noise[2 * i + 1] * noise[2 * i + 1];
                    }
                    detector.update(y, mean);
                }
                const auto found = std::count_if(mean.begin(), mean.end(), [&](float d) { return d > threshold; });
                const double error = std::sqrt(pd * (1.0 - pd) / trials);
                QVERIFY2(std::abs(double(found) / trials - pd) < 4.5 * error,
                         qPrintable(QString("%1 looks, Pd %2").arg(looks).arg(pd)));
            }
    }

    void pOfNAgainstBinomial()
    {
        // Independent cells, one cell wide: an event has probability e^-r1.
        constexpr Index cells = 40000;
        for (const auto &[p, n] : {std::pair{3, 4}, std::pair{6, 8}, std::pair{2, 5}}) {
            PofN detector({{Axis{"cell", "", 0.0, 1.0, cells, false}}}, {p, n, 0.7, 0.0, 1.0});
            Random random(13, std::uint64_t(n));
            std::vector<float> y(cells);
            std::vector<float> statistic(cells);
            for (int frame = 0; frame < n; ++frame) {
                for (float &value : y)
                    value = float(random.exponential());
                detector.update(y, statistic);
            }
            const double expected = pdOfPofN(p, n, std::exp(-0.7));
            const double found =
                double(std::count_if(statistic.begin(), statistic.end(), [](float d) { return d > 0.0f; })) / cells;
            QVERIFY(std::abs(found - expected) < 4.5 * std::sqrt(expected * (1.0 - expected) / cells));
        }
    }

    // That the detector keeps to it is seen in tst_Smd::lindley.
    void lindley()
    {
        QVERIFY(std::abs(lindleySigma(-2.0 * std::log(2.0)) - 0.5) < 1e-12); // resets half
        constexpr double lnK = -1.3;
        const double sigma = lindleySigma(lnK);
        QVERIFY(std::abs(1.0 - sigma - 0.42297) < 1e-5);
        for (const double threshold : {0.0, 2.0, 8.0})
            QVERIFY(std::abs(lindleyExceedance(threshold, lnK) - sigma * std::exp(-(1.0 - sigma) * threshold)) < 1e-12);
    }

    void intervals()
    {
        const Interval half = wilsonInterval(50, 100);
        QVERIFY(std::abs(half.low - 0.40383) < 1e-4 && std::abs(half.high - 0.59617) < 1e-4);
        QCOMPARE(wilsonInterval(0, 10).low, 0.0);
        QCOMPARE(wilsonInterval(10, 10).high, 1.0);
        const Interval ten = poissonInterval(10);
        QVERIFY(std::abs(ten.low - 4.7954) < 1e-3 && std::abs(ten.high - 18.3904) < 1e-3);
        QCOMPARE(poissonInterval(0).low, 0.0);
        QVERIFY(std::abs(poissonInterval(0).high - 3.6889) < 1e-3);
        QVERIFY(normalInterval(2.0, 0.5).contains(2.9) && !normalInterval(2.0, 0.5).contains(3.0));
    }

    void wilsonCovers()
    {
        Random random(15, 0);
        int covered = 0;
        for (int i = 0; i < 4000; ++i) {
            int hits = 0;
            for (int k = 0; k < 60; ++k)
                hits += random.uniform() < 0.9 ? 1 : 0;
            covered += wilsonInterval(hits, 60).contains(0.9) ? 1 : 0;
        }
        QVERIFY(covered > 0.93 * 4000 && covered < 0.975 * 4000);
    }

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

FAINTLINE_TEST(tst_theory)
#include "tst_theory.moc"
