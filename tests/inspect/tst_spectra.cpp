#include "analyse/analyse.h"
#include "inspect/spectra.h"
#include "scene/SimulatedRecording.h"
#include "support/test.h"

#include <cmath>
#include <numeric>

using namespace faintline;

namespace {

std::shared_ptr<const Analysis> noise(double deviation, bool isComplex)
{
    LineScene scene{.sampleRateHz = 500.0, .durationSeconds = 60.0, .isComplex = isComplex};
    scene.noise.deviation = deviation;
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 0.5;
    return analyse(std::make_shared<SimulatedRecording>(scene), settings);
}

double meanOf(const std::vector<double> &values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

} // namespace

/// A frame, and the mean of many, over the noise and as a density.
class tst_spectra : public QObject
{
    Q_OBJECT

private slots:
    /// The spectra are those of the recording: on its own axis, not on the fundamental's.
    void aFamilyHasTheRecordingsSpectra()
    {
        LineScene scene{.sampleRateHz = 500.0, .durationSeconds = 30.0};
        AnalysisSettings settings;
        settings.spectrogram.windowSeconds = 0.5;
        settings.family = {FamilySettings::Relation::Harmonics, {1.0, 2.0, 3.0}, FamilySettings::Present::Together};
        const auto analysis = analyse(std::make_shared<SimulatedRecording>(scene), settings);
        settings.family = {};
        const auto single = analyse(std::make_shared<SimulatedRecording>(scene), settings);
        for (const SpectrumQuantity level : {SpectrumQuantity::Density, SpectrumQuantity::OverNoise}) {
            const Spectra spectra = spectraOf(*analysis, 10.0, {0.0, 30.0}, level);
            const Spectra expected = spectraOf(*single, 10.0, {0.0, 30.0}, level);
            QCOMPARE(spectra.position.back(), 250.0);
            QVERIFY(spectra.frame == expected.frame); // bit for bit
            QVERIFY(spectra.mean == expected.mean);
        }
    }

    void whiteNoiseHasItsDensity()
    {
        for (const bool isComplex : {false, true}) {
            const auto analysis = noise(0.3, isComplex);
            const Spectra spectra = spectraOf(*analysis, 30.0, {0.0, 60.0}, SpectrumQuantity::Density);
            const double expected = (isComplex ? 1.0 : 2.0) * 0.3 * 0.3 / 500.0;
            QVERIFY2(std::abs(meanOf(spectra.mean) / expected - 1.0) < 0.05,
                     qPrintable(QString::number(meanOf(spectra.mean) / expected)));
        }
    }

    void overTheNoiseItIsOne()
    {
        const auto analysis = noise(0.3, false);
        const Spectra spectra = spectraOf(*analysis, 30.0, {0.0, 60.0}, SpectrumQuantity::OverNoise);
        QCOMPARE(std::ssize(spectra.mean), analysis->grid().size());
        QVERIFY(std::abs(meanOf(spectra.mean) - 1.0) < 0.05);
    }

    void theFrameIsTheOneThere()
    {
        const auto analysis = noise(0.3, false);
        std::vector<float> frame(std::size_t(analysis->grid().size()));
        analysis->frames->read(17, 1, frame);
        const double seconds = analysis->time().value(17.2);
        const Spectra spectra = spectraOf(*analysis, seconds, {seconds, seconds}, SpectrumQuantity::OverNoise);
        for (std::size_t cell = 0; cell < frame.size(); ++cell) {
            QCOMPARE(spectra.frame[cell], double(frame[cell]));
            QCOMPARE(spectra.mean[cell], double(frame[cell])); // of one frame
        }
        QCOMPARE(spectra.position[3], analysis->grid().axes.back().value(3.0));
    }
};

FAINTLINE_TEST(tst_spectra)
#include "tst_spectra.moc"
