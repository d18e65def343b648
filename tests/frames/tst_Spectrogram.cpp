#include "frames/Spectrogram.h"
#include "support/test.h"

#include "support/recordings.h"

#include <limits>
#include <thread>

using namespace faintline;
using namespace faintline::test;

namespace {

struct Case {
    bool isComplex = false;
    int windowSamples = 16;
    int steps = 2;
    int binsPerCell = 2;
    WindowShape shape = WindowShape::Hann;
};

constexpr double rate = 1000.0;

SpectrogramSettings settingsOf(const Case &c)
{
    return {c.windowSamples / rate, c.steps, c.binsPerCell, c.shape};
}

std::shared_ptr<MemoryRecording> noise(Index samples, bool isComplex, std::uint64_t stream = 1)
{
    return std::make_shared<MemoryRecording>(someNoise(isComplex ? 2 * samples : samples, stream), rate, isComplex);
}

std::vector<float> allOf(const Spectrogram &spectrogram)
{
    std::vector<float> values(std::size_t(spectrogram.time().count * spectrogram.frequency().count));
    spectrogram.read(0, spectrogram.time().count, values);
    return values;
}

double mean(const std::vector<float> &values)
{
    double sum = 0.0;
    for (float value : values)
        sum += double(value);
    return sum / double(values.size());
}

} // namespace

Q_DECLARE_METATYPE(Case)

/// The sliding spectrum against a direct Fourier transform, its axes, and its cuts in time and frequency.
class tst_Spectrogram : public QObject
{
    Q_OBJECT

private slots:
    void equalsTheDefinition_data()
    {
        QTest::addColumn<Case>("c");
        for (bool isComplex : {false, true}) {
            const char *kind = isComplex ? "complex" : "real";
            QTest::addRow("%s, even", kind) << Case{isComplex, 16, 2, 2};
            QTest::addRow("%s, odd window", kind) << Case{isComplex, 17, 2, 1};    // 18 bins
            QTest::addRow("%s, odd transform", kind) << Case{isComplex, 15, 2, 1}; // 15 bins
            QTest::addRow("%s, odd and padded", kind) << Case{isComplex, 9, 3, 3}; // 27 bins
            QTest::addRow("%s, rounded up", kind) << Case{isComplex, 11, 1, 1};    // 12 bins
            QTest::addRow("%s, no overlap", kind) << Case{isComplex, 20, 1, 4};
            QTest::addRow("%s, hop of one", kind) << Case{isComplex, 8, 64, 1};
            QTest::addRow("%s, two samples", kind) << Case{isComplex, 2, 2, 1};
            QTest::addRow("%s, Billon", kind) << Case{isComplex, 250, 2, 4, WindowShape::Rectangular};
            QTest::addRow("%s, Kaiser", kind) << Case{isComplex, 100, 4, 2, WindowShape::Kaiser};
        }
    }

    void equalsTheDefinition()
    {
        QFETCH(Case, c);
        const auto recording = noise(3 * c.windowSamples + 5, c.isComplex);
        const Spectrogram spectrogram(recording, settingsOf(c));
        const std::vector<float> found = allOf(spectrogram);
        const std::vector<float> samples = readAll(*recording);
        const std::vector<float> window = sampleWindow(c.shape, c.windowSamples);
        const Index floats = c.isComplex ? 2 : 1;

        const int hop = std::max(1, int(std::lround(double(c.windowSamples) / c.steps)));
        QCOMPARE(spectrogram.hopSamples(), hop);
        QCOMPARE(spectrogram.time().count, Index((2 * c.windowSamples + 5) / hop + 1));
        QVERIFY(spectrogram.transformLength() >= c.windowSamples * c.binsPerCell);
        const Index bins = spectrogram.frequency().count;
        QCOMPARE(bins, Index(c.isComplex ? spectrogram.transformLength() : spectrogram.transformLength() / 2 + 1));
        for (Index frame = 0; frame < spectrogram.time().count; ++frame) {
            std::vector<float> windowed(samples.begin() + frame * hop * floats,
                                        samples.begin() + (frame * hop + c.windowSamples) * floats);
            for (std::size_t i = 0; i < windowed.size(); ++i)
                windowed[i] *= window[i / std::size_t(floats)];
            for (Index bin = 0; bin < bins; ++bin) {
                const double turns = spectrogram.frequency().value(double(bin)) / rate;
                const double expected = std::norm(fourier(windowed.data(), c.windowSamples, c.isComplex, turns));
                const auto value = double(found[std::size_t(frame * bins + bin)]);
                QVERIFY2(
                    std::abs(value - expected) < 1e-5 * (expected + 0.04),
                    qPrintable(
                        QString("frame %1, bin %2: %3, directly %4").arg(frame).arg(bin).arg(value).arg(expected)));
            }
        }
    }

    void frequenciesAscendThroughZero()
    {
        const Spectrogram even(noise(100, true), settingsOf({true, 10, 2, 1}));
        QCOMPARE(even.frequency().count, Index(10));
        QCOMPARE(even.frequency().first, -500.0);
        QCOMPARE(even.frequency().step, 100.0);
        QCOMPARE(even.frequency().value(5.0), 0.0);
        QCOMPARE(even.frequency().last(), 400.0);
        const Spectrogram odd(noise(100, true), settingsOf({true, 9, 2, 1}));
        QCOMPARE(odd.frequency().count, Index(9));
        QVERIFY(std::abs(odd.frequency().first + 4.0 * rate / 9.0) < 1e-9);
        QVERIFY(std::abs(odd.frequency().last() - 4.0 * rate / 9.0) < 1e-9);
        const Spectrogram real(noise(100, false), settingsOf({false, 10, 2, 1}));
        QCOMPARE(real.frequency().first, 0.0);
        QCOMPARE(real.frequency().last(), 500.0);
        const Spectrogram oddReal(noise(100, false), settingsOf({false, 9, 2, 1}));
        QCOMPARE(oddReal.frequency().count, Index(5));
        QVERIFY(std::abs(oddReal.frequency().last() - 4.0 * rate / 9.0) < 1e-9);
    }

    void timesAreTheWindowsMiddles()
    {
        const Spectrogram spectrogram(noise(1000, false), settingsOf({false, 100, 4, 1}));
        QCOMPARE(spectrogram.time().first, 0.05);
        QCOMPARE(spectrogram.time().step, 0.025);
        QCOMPARE(spectrogram.time().count, Index(37)); // the last window ends with the last sample
        QVERIFY(std::abs(spectrogram.time().last() - 0.95) < 1e-12);
    }

    void bandIsAPartOfTheWhole_data()
    {
        QTest::addColumn<bool>("isComplex");
        QTest::addColumn<double>("low");
        QTest::addColumn<double>("high");
        QTest::addColumn<int>("firstBin");
        QTest::addColumn<int>("count");
        // Bins of 10 Hz.
        QTest::newRow("inside") << false << 95.0 << 131.0 << 10 << 4;
        QTest::newRow("edges belong to it") << false << 100.0 << 130.0 << 10 << 4;
        QTest::newRow("one bin") << false << 100.0 << 109.0 << 10 << 1;
        QTest::newRow("from below 0") << false << -500.0 << 20.0 << 0 << 3;
        QTest::newRow("beyond the end") << false << 480.0 << 9e9 << 48 << 3;
        QTest::newRow("negative") << true << -300.0 << -290.0 << 20 << 2;
        QTest::newRow("through 0") << true << -20.0 << 20.0 << 48 << 5;
        QTest::newRow("the whole") << true << -1e9 << 1e9 << 0 << 100;
        QTest::newRow("equal edges are the whole") << false << 200.0 << 200.0 << 0 << 51;
    }

    void bandIsAPartOfTheWhole()
    {
        QFETCH(bool, isComplex);
        QFETCH(double, low);
        QFETCH(double, high);
        QFETCH(int, firstBin);
        QFETCH(int, count);
        const auto recording = noise(300, isComplex);
        const Spectrogram whole(recording, settingsOf({isComplex, 50, 2, 2}));
        SelectionSettings selection{.lowHz = low, .highHz = high};
        const Spectrogram band(recording, settingsOf({isComplex, 50, 2, 2}), selection);
        QCOMPARE(band.frequency().count, Index(count));
        QVERIFY(std::abs(band.frequency().first - whole.frequency().value(firstBin)) < 1e-9);
        const std::vector<float> all = allOf(whole);
        const std::vector<float> some = allOf(band);
        for (Index frame = 0; frame < whole.time().count; ++frame)
            QVERIFY(std::equal(some.begin() + frame * count, some.begin() + (frame + 1) * count,
                               all.begin() + frame * whole.frequency().count + firstBin));
    }

    void partOfTheTime()
    {
        const auto recording = noise(1000, true);
        const Spectrogram whole(recording, settingsOf({true, 100, 2, 1}));
        SelectionSettings selection{.fromSeconds = 0.2, .toSeconds = 0.7};
        const Spectrogram part(recording, settingsOf({true, 100, 2, 1}), selection);
        QCOMPARE(part.time().count, Index(9));
        QVERIFY(std::abs(part.time().first - whole.time().value(4.0)) < 1e-12);
        const std::vector<float> all = allOf(whole);
        const std::vector<float> some = allOf(part);
        QVERIFY(std::equal(some.begin(), some.end(), all.begin() + 4 * 100));
    }

    void chunkedEqualsWhole()
    {
        for (const Case &c : {Case{false, 37, 3, 2}, Case{true, 64, 2, 2}}) {
            const Spectrogram spectrogram(noise(2000, c.isComplex), settingsOf(c));
            const std::vector<float> whole = allOf(spectrogram);
            const auto bins = std::size_t(spectrogram.frequency().count);
            std::vector<float> pieces(whole.size());
            Index count = 1;
            // Backwards, so that no frame can lean on the one before it.
            for (Index end = spectrogram.time().count; end > 0; end -= count) {
                count = std::min<Index>(count % 5 + 1, end);
                spectrogram.read(end - count, count,
                                 std::span(pieces).subspan(std::size_t(end - count) * bins, std::size_t(count) * bins));
            }
            QCOMPARE(pieces, whole);
        }
    }

    void longRequestsAreCutInside()
    {
        // More samples than one inner run takes (2²⁰): the frames on both sides of the cut are the same as alone.
        SelectionSettings band{.lowHz = 100.0, .highHz = 103.0};
        const Spectrogram spectrogram(noise(2'500'000, false), settingsOf({false, 4000, 1, 1}), band);
        const std::vector<float> whole = allOf(spectrogram);
        const auto bins = std::size_t(spectrogram.frequency().count);
        std::vector<float> alone(bins);
        for (Index frame = 255; frame < 270; ++frame) {
            spectrogram.read(frame, 1, alone);
            QVERIFY(std::equal(alone.begin(), alone.end(), whole.begin() + frame * std::ssize(alone)));
        }
    }

    void threadsGetTheSameBits()
    {
        const Spectrogram spectrogram(noise(20000, true), settingsOf({true, 200, 2, 2}));
        const std::vector<float> whole = allOf(spectrogram);
        std::vector<std::vector<float>> halves(2);
        {
            std::vector<std::jthread> threads;
            for (auto &half : halves)
                threads.emplace_back([&] { half = allOf(spectrogram); });
        }
        QCOMPARE(halves[0], whole);
        QCOMPARE(halves[1], whole);
    }

    void whiteNoiseHasItsVariance_data()
    {
        QTest::addColumn<bool>("isComplex");
        QTest::addColumn<int>("shape");
        for (std::size_t shape = 0; shape < windowShapeNames.size(); ++shape)
            for (bool isComplex : {false, true})
                QTest::addRow("%s %s", windowShapeNames[shape].data(), isComplex ? "complex" : "real")
                    << isComplex << int(shape);
    }

    void whiteNoiseHasItsVariance()
    {
        QFETCH(bool, isComplex);
        QFETCH(int, shape);
        std::vector<float> samples(isComplex ? 160000 : 80000);
        Random(5, 1).normals(samples, isComplex ? 0.5f * std::numbers::sqrt2_v<float> : 1.0f); // E|x|² = 1
        const auto recording = std::make_shared<MemoryRecording>(samples, rate, isComplex);
        const Spectrogram spectrogram(recording, settingsOf({isComplex, 100, 1, 1, static_cast<WindowShape>(shape)}));
        const std::vector<float> values = allOf(spectrogram);
        // Independent frames, and bins of which not more than three in a row tell the same: y ~ Exp(1), deviation 1.
        const double error = std::sqrt(3.0 / double(values.size()));
        QVERIFY2(std::abs(mean(values) - 1.0) < 4.0 * error,
                 qPrintable(QString("%1 ± %2").arg(mean(values)).arg(error)));
        // The lowest and the highest bin as well (800 values each; for real samples their y is χ² of one degree, variance
        // 2).
        for (std::size_t bin : {std::size_t(0), std::size_t(spectrogram.frequency().count - 1)})
            QVERIFY(std::abs(mean(every(values, std::size_t(spectrogram.frequency().count), bin)) - 1.0)
                    < 4.0 * std::sqrt(2.0 / 800.0));
    }

    void toneHasItsLevelAndBin_data()
    {
        QTest::addColumn<bool>("isComplex");
        QTest::addColumn<double>("hz");
        QTest::addColumn<int>("shape");
        for (int shape : {0, 1, 4}) {
            QTest::addRow("real, shape %d", shape) << false << 210.0 << shape;
            QTest::addRow("I/Q, shape %d", shape) << true << 210.0 << shape;
            QTest::addRow("I/Q below the centre, shape %d", shape) << true << -340.0 << shape;
        }
    }

    void toneHasItsLevelAndBin()
    {
        QFETCH(bool, isComplex);
        QFETCH(double, hz);
        QFETCH(int, shape);
        constexpr double amplitude = 0.5;
        std::vector<float> samples;
        for (int n = 0; n < 500; ++n) {
            const double phase = 2.0 * std::numbers::pi * hz * n / rate + 0.3;
            samples.push_back(float(amplitude * std::cos(phase)));
            if (isComplex)
                samples.push_back(float(amplitude * std::sin(phase)));
        }
        const Spectrogram spectrogram(std::make_shared<MemoryRecording>(samples, rate, isComplex),
                                      settingsOf({isComplex, 100, 2, 2, static_cast<WindowShape>(shape)}));
        // |A Σ w|², a quarter of it for a real tone. Mean and energy of the windows: 1 and 1; 1/2 and 3/8; 0.35875 and
        // 0.25796.
        const double coherentGain = shape == 0 ? 1.0 : shape == 1 ? 0.25 / 0.375 : 0.35875 * 0.35875 / 0.2579635;
        const double expected = amplitude * amplitude * 100.0 * coherentGain * (isComplex ? 1.0 : 0.25);
        const Index bins = spectrogram.frequency().count;
        const Index wanted = spectrogram.frequency().nearest(hz);
        QVERIFY(std::abs(spectrogram.frequency().value(double(wanted)) - hz) < 1e-9);
        const std::vector<float> values = allOf(spectrogram);
        for (Index frame = 0; frame < spectrogram.time().count; ++frame) {
            const auto row = values.begin() + frame * bins;
            QCOMPARE(std::max_element(row, row + bins) - row, wanted);
            const double db = 10.0 * std::log10(double(row[wanted]) / expected);
            // The rectangular window's side lobes let the real tone's own mirror in.
            QVERIFY2(std::abs(db) < (shape == 0 && !isComplex ? 0.2 : 0.01), qPrintable(QString::number(db)));
        }
    }

    void oneWindowIsOneFrame()
    {
        const Spectrogram spectrogram(noise(100, false), settingsOf({false, 100, 8, 1}));
        QCOMPARE(spectrogram.time().count, Index(1));
        QCOMPARE(allOf(spectrogram).size(), std::size_t(51));
    }

    void samplesThatAreNoNumbers()
    {
        std::vector<float> samples = someNoise(400);
        std::vector<float> zeros = samples;
        for (std::size_t i : {std::size_t(0), std::size_t(120), std::size_t(399)}) {
            samples[i] = i == 120 ? std::numeric_limits<float>::infinity() : std::numeric_limits<float>::quiet_NaN();
            zeros[i] = 0.0f;
        }
        const auto recording = std::make_shared<MemoryRecording>(samples, rate);
        const Spectrogram spectrogram(recording, settingsOf({false, 100, 1, 1}));
        const std::vector<float> values = allOf(spectrogram);
        QCOMPARE(values,
                 allOf(Spectrogram(std::make_shared<MemoryRecording>(zeros, rate), settingsOf({false, 100, 1, 1}))));
        QVERIFY(std::ranges::all_of(values, [](float y) { return std::isfinite(y) && y >= 0.0f; }));
        QCOMPARE(recording->nonFiniteCount(), Index(3));
    }

    void otherChannel()
    {
        /// Channel c is a constant c.
        class Constants final : public Recording
        {
        public:
            Constants()
            {
                m_info.sampleRateHz = rate;
                m_info.sampleCount = 100;
                m_info.channelCount = 3;
            }
            void read(int channel, Index, Index, std::span<float> out) const override
            {
                std::ranges::fill(out, float(channel));
            }
        };
        SelectionSettings selection;
        selection.channel = 2;
        const Spectrogram spectrogram(std::make_shared<Constants>(),
                                      settingsOf({false, 100, 1, 1, WindowShape::Rectangular}), selection);
        QVERIFY(std::abs(allOf(spectrogram)[0] - 2.0f * 2.0f * 100.0f) < 1e-3f);
    }

    void refusals_data()
    {
        QTest::addColumn<double>("windowSeconds");
        QTest::addColumn<double>("from");
        QTest::addColumn<double>("to");
        QTest::addColumn<double>("low");
        QTest::addColumn<double>("high");
        QTest::addColumn<int>("channel");
        QTest::addColumn<QString>("message");
        const auto row = [](const char *name, double window, double from, double to, double low, double high,
                            int channel, const char *message) {
            QTest::newRow(name) << window << from << to << low << high << channel << QString::fromUtf8(message);
        };
        row("shorter than a window", 2.0, 0, 0, 0, 0, 0,
            "memory: the selected part is 1000 samples (1 s) long, shorter than one window of 2 s");
        row("part shorter than a window", 0.5, 0.2, 0.6, 0, 0, 0, "the selected part is 400 samples (0.4 s) long");
        row("window of one sample", 0.001, 0, 0, 0, 0, 0,
            "spectrogram.windowSeconds = 0.001: contains fewer than 2 "
            "samples at 1000 Hz");
        row("endless window", 1e6, 0, 0, 0, 0, 0, "gives a transform of more than 100 million points");
        row("behind the end", 0.1, 1.0, 0, 0, 0, 0,
            "selection.fromSeconds = 1: must lie before the end of the selection, "
            "1 s");
        row("from after to", 0.1, 0.8, 0.3, 0, 0, 0,
            "selection.fromSeconds = 0.8: must lie before the end of the "
            "selection, 0.3 s");
        row("band upside down", 0.1, 0, 0, 200, 100, 0, "selection.lowHz = 200: must not lie above selection.highHz");
        row("band between bins", 0.1, 0, 0, 101, 102, 0, "contains no bin; the recording spans 0 … 500 Hz");
        row("band above the recording", 0.1, 0, 0, 600, 700, 0, "contains no bin; the recording spans 0 … 500 Hz");
        row("band below the recording", 0.1, 0, 0, -700, -600, 0, "contains no bin; the recording spans 0 … 500 Hz");
        row("channel", 0.1, 0, 0, 0, 0, 1, "selection.channel = 1: the recording has 1 channel(s), counted from 0");
    }

    void refusals()
    {
        QFETCH(double, windowSeconds);
        QFETCH(double, from);
        QFETCH(double, to);
        QFETCH(double, low);
        QFETCH(double, high);
        QFETCH(int, channel);
        QFETCH(QString, message);
        const std::string said = errorOf([&] {
            Spectrogram(noise(1000, false), {windowSeconds, 2, 1}, {channel, {}, from, to, low, high});
        });
        QVERIFY2(contains(said, message.toStdString()), said.c_str());
    }

    void automaticWindow_data()
    {
        QTest::addColumn<double>("seconds");
        QTest::addColumn<double>("rateHz");
        QTest::addColumn<double>("window");
        // 3·√(duration/rate), rounded to 1, 2, 5 · 10ⁿ.
        QTest::newRow("a minute of speech") << 60.0 << 8000.0 << 0.2;       // 0.26
        QTest::newRow("a day of shortwave") << 86400.0 << 12.0 << 200.0;    // 255
        QTest::newRow("an hour at 1 Hz") << 3600.0 << 1.0 << 200.0;         // 180
        QTest::newRow("a second of radio") << 1.0 << 2e6 << 0.002;          // 0.0021
        QTest::newRow("at least 16 samples") << 0.1 << 1000.0 << 0.02;      // 0.03 is 30 samples
        QTest::newRow("at most four million") << 1e9 << 50000.0 << 80.0;    // 424, of 31 years
        QTest::newRow("no more than a quarter") << 0.05 << 100.0 << 0.0125; // 0.067, but the recording is short
    }

    void automaticWindow()
    {
        QFETCH(double, seconds);
        QFETCH(double, rateHz);
        QFETCH(double, window);
        RecordingInfo info;
        info.sampleRateHz = rateHz;
        info.sampleCount = Index(std::llround(seconds * rateHz));
        QVERIFY2(std::abs(Spectrogram::automaticWindowSeconds(info) - window) < 1e-9 * window,
                 qPrintable(QString::number(Spectrogram::automaticWindowSeconds(info))));
    }

    void automaticWindowOfAGappyRecordingFitsItsStretches()
    {
        RecordingInfo info;
        info.sampleRateHz = 40.0;
        info.sampleCount = 40'000;
        QCOMPARE(Spectrogram::automaticWindowSeconds(info), 20.0);
        for (Index second = 0; second < 1000; second += 10) // nine seconds of ten
            info.places.add(40 * second, 36 * second, 360);
        QCOMPARE(Spectrogram::automaticWindowSeconds(info), 2.25);
        // Half of all samples lie in one long stretch.
        info.places.add(40'000, 36'000, 36'000);
        info.sampleCount = 76'000;
        QCOMPARE(Spectrogram::automaticWindowSeconds(info), 20.0);
    }
};

FAINTLINE_TEST(tst_Spectrogram)
#include "tst_Spectrogram.moc"
