#include "base/Error.h"
#include "inspect/straighten.h"
#include "scene/SimulatedRecording.h"
#include "signal/ArrayRecording.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

using namespace faintline;

/// One line in one long transform.
class tst_lineHeight : public QObject
{
    Q_OBJECT

private slots:
    void findsTheLineOfOneTransform()
    {
        LineScene scene{.sampleRateHz = 500.0, .durationSeconds = 100.0};
        scene.noise.deviation = 0.1;
        scene.lines = {LineSettings{.snrDb = 0.0, .referenceSeconds = 1.0, .frequencyHz = 80.125}};
        const SimulatedRecording recording(scene);
        const LineHeight height = lineHeight(recording, {0, 0.0, 100.0, 80.0, 5.0});
        QVERIFY2(std::abs(height.hz - 80.125) < 0.005, qPrintable(QString::number(height.hz)));
        // 0 dB in 1 s, 100 s, 1.76 dB for the Hann window, and the median of noise lies 1.59 dB below its mean.
        QVERIFY2(std::abs(height.db - (20.0 - 1.76 + 1.59)) < 1.5, qPrintable(QString::number(height.db)));
    }

    /// |Σ Hann(n) x(n) e^(-2πi f n)|² of the samples themselves.
    void theSpectrumIsThatOfAPlainTransform()
    {
        LineScene scene{.sampleRateHz = 500.0, .durationSeconds = 20.0};
        scene.noise.deviation = 0.1;
        scene.lines = {LineSettings{.snrDb = 20.0, .referenceSeconds = 1.0, .frequencyHz = 80.125},
                       LineSettings{.snrDb = 14.0, .referenceSeconds = 1.0, .frequencyHz = 78.4}};
        const SimulatedRecording recording(scene);
        const TimeBand stretch{0, 0.0, 20.0, 80.0, 5.0};
        const LineSpectrum spectrum = lineSpectrum(recording, stretch);
        QCOMPARE(spectrum.hz.size(), spectrum.db.size());
        QVERIFY(spectrum.hz.front() < 75.1 && spectrum.hz.front() >= 75.0 && spectrum.hz.back() > 84.9);
        std::vector<float> samples(10000);
        recording.read(0, 0, std::ssize(samples), samples);
        std::vector<double> plain;
        for (const double hz : spectrum.hz) {
            std::complex<double> sum = 0.0;
            for (std::size_t n = 0; n < samples.size(); ++n) {
                const double sine = std::sin(std::numbers::pi * (double(n) + 0.5) / double(samples.size()));
                sum += sine * sine * double(samples[n])
                       * std::polar(1.0, -2.0 * std::numbers::pi * hz * double(n) / 500.0);
            }
            plain.push_back(10.0 * std::log10(std::norm(sum)));
        }
        const double highest = *std::max_element(plain.begin(), plain.end());
        const double shown = *std::max_element(spectrum.db.begin(), spectrum.db.end());
        QCOMPARE(shown, lineHeight(recording, stretch).db);
        for (std::size_t i = 0; i < plain.size(); ++i)
            if (plain[i] > highest - 15.0)
                QVERIFY2(std::abs((plain[i] - highest) - (spectrum.db[i] - shown)) < 0.2,
                         qPrintable(QStringLiteral("%1 Hz: %2, %3")
                                        .arg(spectrum.hz[i])
                                        .arg(plain[i] - highest)
                                        .arg(spectrum.db[i] - shown)));
    }

    /// Nothing is read beyond what there is: the band ends at half the rate.
    void takesABandWiderThanTheRecordings()
    {
        LineScene scene{.sampleRateHz = 500.0, .durationSeconds = 2.0};
        scene.noise.deviation = 0.1;
        const LineHeight height = lineHeight(SimulatedRecording(scene), {0, 0.0, 2.0, 80.0, 1e6});
        QVERIFY(std::isfinite(height.db) && std::abs(height.hz - 80.0) <= 250.0);
    }

    void isInfiniteOverSilence()
    {
        const auto samples = std::make_shared<std::vector<float>>(1000, 0.0f);
        const ArrayRecording silent("silence", std::shared_ptr<const float>(samples, samples->data()),
                                    ArrayLayout{100.0, 1000, 1, false, 0.0});
        QVERIFY(!std::isfinite(lineHeight(silent, {0, 0.0, 10.0, 20.0, 5.0}).db));
    }

    void refusesWhatIsTooShort()
    {
        LineScene scene{.sampleRateHz = 500.0, .durationSeconds = 2.0};
        const SimulatedRecording recording(scene);
        for (const TimeBand &stretch :
             {TimeBand{0, 0.0, 0.01, 80.0, 5.0}, TimeBand{0, 1.0, 1.0, 80.0, 5.0}, TimeBand{0, 1.5, 1.0, 80.0, 5.0},
              TimeBand{0, 0.0, 2.0, 80.0, 0.0}, TimeBand{0, 0.0, 2.0, 80.0, std::numeric_limits<double>::quiet_NaN()}})
            QVERIFY_EXCEPTION_THROWN(lineHeight(recording, stretch), Error);
    }
};

FAINTLINE_TEST(tst_lineHeight)
#include "tst_lineHeight.moc"
