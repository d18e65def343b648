#include "evaluate/comparison/noiseFit.h"
#include "support/test.h"

#include "base/Random.h"
#include "support/frames.h"

#include <cmath>

using namespace faintline;

/// Noise against its law: what is counted, how far it is off, and what that does to false alarms.
class tst_noiseFit : public QObject
{
    Q_OBJECT

private slots:
    void fourValuesByEye()
    {
        NoiseLaw law;
        law.add(std::vector<float>{0.5f, 1.0f, 1.5f, 5.0f});
        QCOMPARE(law.count(), std::int64_t(4));
        QCOMPARE(law.mean(), 2.0);
        QCOMPARE(law.exceedance(0.25), 1.0);
        QCOMPARE(law.exceedance(0.75), 0.75);
        QCOMPARE(law.exceedance(2.0), 0.25);
        QCOMPARE(law.exceedance(6.0), 0.0);
        QVERIFY(std::abs(law.quantile(0.25) - 5.0) < 2e-3);
        QVERIFY(std::abs(law.quantile(0.5) - 1.5) < 2e-3);
        // Largest gap just below 0.5: no value below, the law has 1 - e^-0.5 = 0.393; at 5: 1 - e^-1.5 - 0.5 = 0.277.
        QVERIFY(std::abs(law.distance() - 0.393469) < 1e-3);
    }

    void leavesOutWhatWasNotObserved()
    {
        const float none = std::numeric_limits<float>::quiet_NaN();
        NoiseLaw law;
        law.add(std::vector<float>{0.5f, none, 1.5f, none});
        QCOMPARE(law.count(), std::int64_t(2));
        QCOMPARE(law.mean(), 1.0);
        // Four bins, of which the upper two are a stop band.
        std::vector<float> y = cells(4000, 1, 3);
        for (std::size_t i = 0; i < y.size(); ++i)
            if (i % 4 >= 2)
                y[i] = none;
        const auto bands = fitNoise(frames(4, y), {2});
        QCOMPARE(bands.size(), std::size_t(1));
        QCOMPARE(bands[0].law.count(), std::int64_t(2000));
    }

    void theLawItselfFits()
    {
        NoiseLaw law;
        law.add(cells(100000, 1, 0));
        // 4.5 standard errors of Kolmogorov's law lie at 2.4/√n.
        QVERIFY(law.distance() < 2.4 / std::sqrt(100000.0) + 1e-3);
        for (const double p : {0.5, 0.1, 0.01})
            QVERIFY(std::abs(law.quantile(p) + std::log(p)) < 4.5 * std::sqrt((1.0 - p) / p / 100000.0) + 1e-3);
    }

    void anotherLawDoesNot()
    {
        NoiseLaw law;
        law.add(cells(50000, 2, 0));
        // Two looks: P(y > t) = e^{-2t}(1 + 2t); sup against e^{-t} found on a grid.
        double worst = 0.0;
        for (double t = 0.0; t < 10.0; t += 1e-3)
            worst = std::max(worst, std::abs(std::exp(-2.0 * t) * (1.0 + 2.0 * t) - std::exp(-t)));
        QVERIFY(std::abs(law.distance() - worst) < 2.4 / std::sqrt(50000.0) + 1e-3);
        QVERIFY(law.distance() > NoiseLaw::distanceLimit(50000.0));
    }

    void bandsAreSeparate()
    {
        // Two bins: the lower one of mean 1, the upper one three times as strong.
        std::vector<float> y = cells(4000, 1, 3);
        for (std::size_t i = 1; i < y.size(); i += 2)
            y[i] *= 3.0f;
        const auto bands = fitNoise(frames(2, y), {2});
        QCOMPARE(bands.size(), std::size_t(2));
        QCOMPARE(bands[0].low, 100.0);
        QCOMPARE(bands[0].high, 102.0);
        QCOMPARE(bands[1].high, 104.0);
        // Of what is left out at the ends nothing is counted.
        const auto inner = fitNoise(frames(4, y), {1, 4000, 1});
        QCOMPARE(inner.front().low, 102.0);
        QCOMPARE(inner.front().high, 106.0);
        QCOMPARE(inner.front().law.count(), std::int64_t(2000));
        QCOMPARE(bands[0].law.count(), std::int64_t(2000));
        QVERIFY(std::abs(bands[0].law.mean() - 1.0) < 4.5 / std::sqrt(2000.0));
        QVERIFY(std::abs(bands[1].law.mean() - 3.0) < 4.5 * 3.0 / std::sqrt(2000.0));
        QVERIFY(bands[0].fits());
        QVERIFY(!bands[1].fits());
        // Never more bands than bins; overlap leaves fewer independent values.
        QCOMPARE(fitNoise(frames(2, y), {8}).size(), std::size_t(2));
        QCOMPARE(fitNoise(frames(2, y), {1}, {2.0, 4.0}).front().independent, 500.0);
    }

    void frameStrideBoundsTheWork()
    {
        const auto bands = fitNoise(frames(4, cells(4000, 1, 5)), {1, 400}, {2.0, 1.0});
        QCOMPARE(bands.front().law.count(), std::int64_t(400));
        QCOMPARE(bands.front().independent, 400.0); // every tenth frame: those no longer overlap
    }

    void energyDetectorSeesTheLawItself()
    {
        NoiseLaw law;
        law.add(cells(400000, 2, 1));
        AnalysisSettings settings;
        settings.detector = EnergySettings();
        const double threshold = 3.0;
        const MisfitPfa pfa = misfitPfa(std::vector{band(law)}, settings, std::exp(-threshold)).front();
        const double actual = std::exp(-2.0 * threshold) * (1.0 + 2.0 * threshold);
        const double n = 256.0 * 6000.0;
        // The threshold is found on as many cells: its error, 1/√(n·nominal) of e^{-T}, moves the other law along its
        // slope.
        const double slope = 4.0 * threshold * std::exp(-2.0 * threshold);
        const double thresholdError = 1.0 / std::sqrt(n * std::exp(-threshold));
        QVERIFY(std::abs(pfa.actual - actual)
                < 4.5 * std::sqrt(actual / 400000.0 + actual / n + slope * slope * thresholdError * thresholdError));
    }

    void theLawHasNoMisfit()
    {
        NoiseLaw law;
        law.add(cells(1000000, 1, 2));
        AnalysisSettings settings;
        settings.model.lowestSlope = settings.model.highestSlope = 0;
        settings.model.slopeChange = {1.0};
        // The same random numbers through both laws: what is left is the law's own sampling error.
        const MisfitPfa pfa = misfitPfa(std::vector{band(law)}, settings, 1e-5).front();
        QVERIFY(pfa.nominal > 0.0);
        QVERIFY2(std::abs(std::log(pfa.ratio())) < 0.1, qPrintable(QString::number(pfa.ratio())));
    }

    void cancels()
    {
        std::stop_source source;
        source.request_stop();
        RunContext context;
        context.stop = source.get_token();
        QVERIFY_EXCEPTION_THROWN(fitNoise(frames(2, cells(20, 1, 0)), {1}, {}, context), Cancelled);
        QVERIFY_EXCEPTION_THROWN(misfitPfa(std::vector{FittedBand()}, AnalysisSettings(), 1e-3, context), Cancelled);
    }

private:
    /// Cells of mean 1: exponential, or gamma of `looks` looks.
    static std::vector<float> cells(std::size_t count, int looks, std::uint64_t stream)
    {
        Random random(7, stream);
        std::vector<float> y(count);
        for (float &value : y) {
            double sum = 0.0;
            for (int i = 0; i < looks; ++i)
                sum += random.exponential();
            value = float(sum / looks);
        }
        return y;
    }

    static FittedBand band(const NoiseLaw &law)
    {
        FittedBand result;
        result.law = law;
        return result;
    }

    static FrameArray frames(Index bins, std::vector<float> y) { return *test::framesOf(bins, std::move(y), 1.0, 2.0); }
};

FAINTLINE_TEST(tst_noiseFit)
#include "tst_noiseFit.moc"
