// A box's levels: sums one can check by hand, and a simulated line's own SNR whatever the window.

#include "base/Error.h"
#include "frames/Spectrogram.h"
#include "inspect/boxLevels.h"
#include "noise/NoiseNormaliser.h"
#include "scene/SimulatedRecording.h"
#include "support/frames.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;

class tst_boxLevels : public QObject
{
    Q_OBJECT

    static constexpr double seconds = 400.0;

    static std::shared_ptr<const Analysis> sceneOf(std::optional<double> snrDb, WindowShape window)
    {
        LineScene scene{.sampleRateHz = 1000.0, .durationSeconds = seconds};
        if (snrDb) {
            LineSettings line{.snrDb = *snrDb, .referenceSeconds = 0.5, .frequencyHz = 150.0};
            scene.lines.push_back(line);
        }
        auto analysis = std::make_shared<Analysis>();
        analysis->recording = std::make_shared<SimulatedRecording>(scene);
        analysis->settings.spectrogram.windowSeconds = 0.5;
        analysis->settings.spectrogram.window = window;
        const auto spectrogram = std::make_shared<Spectrogram>(analysis->recording, analysis->settings.spectrogram);
        const NormaliserSettings &noise = analysis->settings.noise;
        analysis->frames =
            std::make_shared<NormalisedSpectrogram>(spectrogram, estimateBackground(*spectrogram, noise), noise);
        return analysis;
    }

    /// Of that many resolution cells round 150 Hz, from end to end.
    static FrameBox boxOf(const Analysis &analysis, double cells)
    {
        const Axis &hz = analysis.frames->grid().axes.front();
        const double half = 0.5 * cells / 0.5;
        return {0, analysis.frames->time().count, hz.nearest(150.0 - half), hz.nearest(150.0 + half) + 1};
    }

private slots:
    void sumsAreThoseOfTheCells()
    {
        Analysis analysis;
        analysis.frames = test::framesOf(4, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, 1.0, 10.0);
        const BoxLevels levels = boxLevels(analysis, {1, 3, 1, 3});
        QVERIFY(std::abs(levels.meanDb - 10.0 * std::log10((6.0 + 7.0 + 10.0 + 11.0) / 4.0)) < 1e-12);
        // No cell lies two beyond it: the noise is what frames are normalised to, r = Σ (y − 1) / T.
        QVERIFY(std::abs(levels.snrDb.value() - 10.0 * std::log10((34.0 - 4.0) / 2.0)) < 1e-12);
    }

    void whatIsNotThereIsRefused()
    {
        Analysis analysis;
        analysis.frames = test::framesOf(2, {1, 2});
        for (const FrameBox box : {FrameBox{0, 0, 0, 1}, FrameBox{0, 2, 0, 1}, FrameBox{0, 1, 1, 1},
                                   FrameBox{0, 1, -1, 1}, FrameBox{0, 1, 0, 3}})
            QVERIFY_EXCEPTION_THROWN(boxLevels(analysis, box), Error);
    }

    void aLineHasItsOwnSnr_data()
    {
        using enum WindowShape;
        QTest::addColumn<int>("window");
        QTest::addColumn<double>("snrDb");
        QTest::newRow("rectangular, 10 dB") << int(Rectangular) << 10.0;
        QTest::newRow("Hann, 10 dB") << int(Hann) << 10.0;
        QTest::newRow("Blackman-Harris, 10 dB") << int(BlackmanHarris) << 10.0;
        QTest::newRow("Hann, 0 dB") << int(Hann) << 0.0;
        QTest::newRow("Hann, -5 dB") << int(Hann) << -5.0;
    }

    void aLineHasItsOwnSnr()
    {
        QFETCH(int, window);
        QFETCH(double, snrDb);
        constexpr double cells = 12.0;
        const auto analysis = sceneOf(snrDb, static_cast<WindowShape>(window));
        const BoxLevels levels = boxLevels(*analysis, boxOf(*analysis, cells));
        const double r = std::pow(10.0, 0.1 * snrDb);
        // In each of 800 windows the sum over the cells has the variance of noise in all of them and of the line's beat
        // with it.
        const double error = std::sqrt((2.0 * r + cells) / (seconds / 0.5));
        const double found = levels.snrDb ? std::pow(10.0, 0.1 * *levels.snrDb) : 0.0;
        QVERIFY2(std::abs(found - r) < 4.0 * error,
                 qPrintable(QStringLiteral("%1 for %2 ± %3").arg(found).arg(r).arg(error)));
    }

    void noiseHasNone()
    {
        const auto analysis = sceneOf({}, WindowShape::Hann);
        constexpr double cells = 12.0;
        const BoxLevels levels = boxLevels(*analysis, boxOf(*analysis, cells));
        const double found = levels.snrDb ? std::pow(10.0, 0.1 * *levels.snrDb) : 0.0;
        QVERIFY2(found < 4.0 * std::sqrt(cells / (seconds / 0.5)), qPrintable(QString::number(found)));
        QVERIFY(std::abs(levels.meanDb) < 0.2);
    }
};

FAINTLINE_TEST(tst_boxLevels)
#include "tst_boxLevels.moc"
