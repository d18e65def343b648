#include "noise/NoiseNormaliser.h"
#include "support/recordings.h"
#include "support/test.h"

#include <numbers>
#include <numeric>

using namespace faintline;
using namespace faintline::test;

/// What a filter left of the noise beside it is excluded; what is faint, but there by itself, is not.
class tst_stopBands : public QObject
{
    Q_OBJECT

private slots:
    void imagesAfterResampling();
    void remaindersThatFollow();
    void bothEnds();
    void noiseOfItsOwn_data();
    void noiseOfItsOwn();
    void naturalSlopes_data();
    void naturalSlopes();
    void aSelectedBandIsSearched();
    void tooShortToTell();
};

namespace {

constexpr double rate = 1000.0;
constexpr int taps = 257;
constexpr Index count = 160000;
constexpr float faint = 0.0316f; ///< -30 dB

using Samples = std::vector<float>;

Samples white(std::uint64_t stream, float deviation = 1.0f)
{
    Samples values(std::size_t(count + taps));
    Random(44, stream).normals(values, deviation);
    return values;
}

/// Levels of 3.5 dB deviation, a new one every 0.37 s.
Samples varying(Samples samples, std::uint64_t stream = 1)
{
    constexpr std::size_t length = 370;
    Samples gains(samples.size() / length + 1);
    Random(45, stream).normals(gains, 0.4f);
    for (std::size_t n = 0; n < samples.size(); ++n)
        samples[n] *= std::exp(gains[n / length]);
    return samples;
}

/// The middle of the samples after a filter by Blackman's window, 21 Hz from pass band to -74 dB.
Samples passed(const Samples &samples, double halfWidthHz, double centreHz = 0.0)
{
    Samples filter(taps);
    for (int i = 0; i < taps; ++i) {
        const double t = i - taps / 2;
        const double phase = 2.0 * std::numbers::pi * i / (taps - 1);
        const double blackman = 0.42 - 0.5 * std::cos(phase) + 0.08 * std::cos(2.0 * phase);
        const double cutOff = 2.0 * halfWidthHz / rate;
        const double sine = t == 0.0 ? cutOff : std::sin(cutOff * std::numbers::pi * t) / (std::numbers::pi * t);
        const double shift = centreHz > 0.0 ? 2.0 * std::cos(2.0 * std::numbers::pi * centreHz / rate * t) : 1.0;
        filter[std::size_t(i)] = float(blackman * sine * shift);
    }
    Samples result(static_cast<std::size_t>(count));
    for (std::size_t n = 0; n < result.size(); ++n)
        result[n] = std::inner_product(filter.begin(), filter.end(), samples.begin() + std::ptrdiff_t(n), 0.0f);
    return result;
}

/// The same samples without a filter, in the same places; and a share of them.
Samples middle(const Samples &samples, float share)
{
    Samples result(samples.begin() + taps / 2, samples.begin() + taps / 2 + count);
    for (float &value : result)
        value *= share;
    return result;
}

Samples sum(Samples a, const Samples &b)
{
    for (std::size_t n = 0; n < a.size(); ++n)
        a[n] += b[n];
    return a;
}

struct Normalised {
    std::shared_ptr<const NormalisedSpectrogram> frames;

    const std::vector<StopBand> &bands() const { return frames->background().stopBands; }
    /// Mean over all frames of the strongest bin between two frequencies; NaN if none was observed.
    double strongest(double lowHz, double highHz) const
    {
        const Axis &axis = frames->grid().axes.front();
        std::vector<float> y(static_cast<std::size_t>(axis.count));
        std::vector<double> means(y.size(), 0.0);
        for (Index frame = 0; frame < frames->time().count; ++frame) {
            frames->read(frame, 1, y);
            for (std::size_t bin = 0; bin < y.size(); ++bin)
                means[bin] += double(y[bin]) / double(frames->time().count);
        }
        double largest = std::nan("");
        for (Index bin = axis.nearest(lowHz); bin <= axis.nearest(highHz); ++bin)
            largest = std::fmax(largest, means[std::size_t(bin)]);
        return largest;
    }
};

Normalised normalised(Samples samples, const SelectionSettings &selection = {})
{
    const auto recording = std::make_shared<MemoryRecording>(std::move(samples), rate, false);
    const auto spectrogram = std::make_shared<Spectrogram>(recording, SpectrogramSettings{0.5, 2, 2}, selection);
    return {std::make_shared<NormalisedSpectrogram>(spectrogram, estimateBackground(*spectrogram, {}),
                                                    NormaliserSettings())};
}

/// Steady noise up to 250 Hz, at 500 samples a second, with a zero put after each sample; of its images 30 dB less.
Samples resampled()
{
    Samples stuffed = white(1);
    for (std::size_t n = 1; n < stuffed.size(); n += 2)
        stuffed[n] = 0.0f;
    return sum(middle(stuffed, faint), passed(stuffed, 250.0));
}

bool isExcluded(const Normalised &n, double lowHz, double highHz)
{
    return std::isnan(n.strongest(lowHz, highHz));
}

} // namespace

void tst_stopBands::imagesAfterResampling()
{
    const Normalised n = normalised(resampled());
    QCOMPARE(n.bands().size(), std::size_t(1));
    const StopBand &band = n.bands().front();
    QVERIFY2(band.lowHz > 248.0 && band.lowHz < 272.0, qPrintable(QString::number(band.lowHz)));
    QVERIFY(band.highHz >= 500.0);
    QVERIFY2(std::abs(band.depthDb - 30.0) < 2.0, qPrintable(QString::number(band.depthDb)));
    QVERIFY(isExcluded(n, 280.0, 500.0));
    QVERIFY(std::abs(n.strongest(100.0, 100.0) - 1.0) < 0.3);
    QVERIFY(!isExcluded(n, 0.0, 240.0));
}

void tst_stopBands::remaindersThatFollow()
{
    const Samples noise = varying(white(2));
    const Normalised n = normalised(sum(passed(noise, 250.0), middle(varying(white(3)), faint)));
    QCOMPARE(n.bands().size(), std::size_t(1));
    QVERIFY(isExcluded(n, 280.0, 500.0));
}

void tst_stopBands::bothEnds()
{
    const Samples noise = varying(white(4));
    const Normalised n = normalised(sum(passed(noise, 150.0, 250.0), middle(varying(white(5)), faint)));
    QCOMPARE(n.bands().size(), std::size_t(2));
    QVERIFY(isExcluded(n, 0.0, 70.0) && isExcluded(n, 430.0, 500.0));
    QVERIFY(std::abs(n.strongest(250.0, 250.0) - 1.0) < 0.3);
}

void tst_stopBands::noiseOfItsOwn_data()
{
    QTest::addColumn<bool>("varies");
    QTest::addColumn<bool>("variesByItself");
    QTest::newRow("all steady") << false << false;
    QTest::newRow("the loud band varies") << true << false;
    QTest::newRow("the quiet band varies") << false << true;
    QTest::newRow("both, each by itself") << true << true;
}

/// The same steep edge and depth; a line in the quiet band is seen.
void tst_stopBands::noiseOfItsOwn()
{
    QFETCH(bool, varies);
    QFETCH(bool, variesByItself);
    const Samples loud = passed(varies ? varying(white(6)) : white(6), 250.0);
    Samples samples = sum(loud, middle(variesByItself ? varying(white(7), 2) : white(7), faint));
    for (std::size_t n = 0; n < samples.size(); ++n)
        samples[n] += 0.02f * float(std::cos(2.0 * std::numbers::pi * 0.4 * double(n))); // 15 dB there
    const Normalised n = normalised(samples);
    QVERIFY(n.bands().empty());
    QVERIFY2(n.strongest(398.0, 402.0) > 5.0, qPrintable(QString::number(n.strongest(398.0, 402.0))));
}

void tst_stopBands::naturalSlopes_data()
{
    QTest::addColumn<int>("poles");
    QTest::addColumn<double>("pole");
    QTest::newRow("30 dB over the band") << 1 << 0.94;
    QTest::newRow("60 dB, most of it below 100 Hz") << 2 << 0.94;
    QTest::newRow("as the sea's, far steeper") << 4 << 0.9;
    QTest::newRow("six poles") << 6 << 0.6;
}

/// All of it varies together, and is not cut off.
void tst_stopBands::naturalSlopes()
{
    QFETCH(int, poles);
    QFETCH(double, pole);
    Samples samples = varying(white(8));
    for (int i = 0; i < poles; ++i) {
        float state = 0.0f;
        for (float &sample : samples)
            sample = state = float(pole) * state + float(1.0 - pole) * sample;
    }
    samples.resize(std::size_t(count));
    const Normalised n = normalised(samples);
    QVERIFY(n.bands().empty());
    QVERIFY(!isExcluded(n, 300.0, 480.0));
}

void tst_stopBands::aSelectedBandIsSearched()
{
    SelectionSettings selection;
    selection.lowHz = 200.0;
    selection.highHz = 450.0;
    const Normalised n = normalised(resampled(), selection);
    QVERIFY(n.bands().empty());
    QVERIFY(!isExcluded(n, 300.0, 400.0));
}

void tst_stopBands::tooShortToTell()
{
    Samples samples = resampled();
    samples.resize(samples.size() / 2); // 160 windows
    QVERIFY(normalised(samples).bands().empty());
}

FAINTLINE_TEST(tst_stopBands)
#include "tst_stopBands.moc"
