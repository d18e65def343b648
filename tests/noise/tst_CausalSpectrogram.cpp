#include "noise/CausalSpectrogram.h"
#include "support/test.h"

#include "noise/levels.h"
#include "support/recordings.h"

#include <numbers>
#include <numeric>

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr double rate = 1000.0;
constexpr double windowSeconds = 0.25;
constexpr Index blockWindows = 48;

std::vector<float> gaussian(Index count, std::uint64_t stream, float deviation = 1.0f)
{
    std::vector<float> values(static_cast<std::size_t>(count));
    Random(31, stream).normals(values, deviation);
    return values;
}

CausalSpectrogram causal(RecordingPointer recording, int steps = 2)
{
    SpectrogramSettings spectral{.windowSeconds = windowSeconds, .stepsPerWindow = steps};
    NormaliserSettings noise;
    noise.causal = true;
    return {std::make_shared<Spectrogram>(std::move(recording), spectral), noise};
}

CausalSpectrogram causal(std::vector<float> samples, int steps = 2)
{
    return causal(std::make_shared<MemoryRecording>(std::move(samples), rate), steps);
}

std::vector<float> readFrames(const CausalSpectrogram &frames, Index first, Index count)
{
    std::vector<float> y(std::size_t(count * frames.grid().size()));
    frames.read(first, count, y);
    return y;
}

double meanOf(std::span<const float> y)
{
    return std::accumulate(y.begin(), y.end(), 0.0) / double(y.size());
}

/// Of frames first … end-1, bins from … to-1.
double meanOf(const CausalSpectrogram &frames, Index first, Index end, Index from, Index to)
{
    double sum = 0.0;
    const std::vector<float> y = readFrames(frames, first, end - first);
    for (Index frame = 0; frame < end - first; ++frame)
        for (Index bin = from; bin < to; ++bin)
            sum += double(y[std::size_t(frame * frames.grid().size() + bin)]);
    return sum / double((end - first) * (to - from));
}

QByteArray said(double value)
{
    return QByteArray::number(value);
}

} // namespace

/// Noise becomes noise of mean 1 over a background from the past alone, and what is to come changes no byte.
class tst_CausalSpectrogram : public QObject
{
    Q_OBJECT

private slots:
    // The margin lowers the first frames by some percent, and less later on.
    void whiteNoiseHasMeanOne()
    {
        for (const int steps : {1, 2, 4}) {
            const CausalSpectrogram frames = causal(gaussian(200'000, 1), steps);
            const Index count = frames.time().count;
            const double early = meanOf(frames, 0, blockWindows * steps, 4, 120);
            const double late = meanOf(frames, count / 2, count, 4, 120);
            QVERIFY2(std::abs(early - 1.0) < 0.08, said(early));
            QVERIFY2(std::abs(late - 1.0) < 0.02, said(late));
        }
    }

    // The oracle: a recording that goes on differently from some sample on. Frames before it, but for the first block,
    // which is estimated as a whole, do not know.
    void theFutureChangesNothing()
    {
        const std::vector<float> whole = gaussian(60'000, 2);
        const CausalSpectrogram known = causal(whole);
        for (const Index cut : {13'000, 30'000, 45'123}) {
            std::vector<float> other = whole;
            const std::vector<float> loud = gaussian(std::ssize(whole) - cut, 3, 7.0f);
            std::copy(loud.begin(), loud.end(), other.begin() + cut);
            const CausalSpectrogram changed = causal(other);
            const Index window = changed.spectrogram()->windowSamples();
            const Index same = (cut - window) / changed.spectrogram()->hopSamples() + 1;
            QVERIFY(same >= (blockWindows - 1) * 2 + 1);
            QVERIFY(readFrames(known, 0, same) == readFrames(changed, 0, same));
            QVERIFY(readFrames(known, same, 4) != readFrames(changed, same, 4));
            other.resize(std::size_t(cut)); // and one that ends there
            QVERIFY(readFrames(known, 0, same) == readFrames(causal(other), 0, same));
        }
    }

    void framesAreAFunctionOfTheirIndex()
    {
        std::vector<float> samples = gaussian(80'000, 4);
        for (std::size_t i = 40'000; i < samples.size(); ++i)
            samples[i] *= 3.0f;
        const CausalSpectrogram inOrder = causal(samples);
        const CausalSpectrogram anyhow = causal(samples);
        const Index count = inOrder.time().count;
        const std::vector<float> all = readFrames(inOrder, 0, count);
        const Index cells = inOrder.grid().size();
        Random random(5, 1);
        for (int i = 0; i < 60; ++i) {
            const auto first = Index(random.uniform() * double(count - 8));
            const Index run = 1 + i % 8;
            const std::vector<float> some = readFrames(anyhow, first, run);
            QVERIFY(std::equal(some.begin(), some.end(), all.begin() + first * cells));
        }
    }

    void levelDoesNotMatter()
    {
        std::vector<float> samples = gaussian(40'000, 6);
        const std::vector<float> plain = readFrames(causal(samples), 0, 300);
        for (float &value : samples)
            value *= 1024.0f;
        QVERIFY(largestDifference(plain, readFrames(causal(samples), 0, 300)) < 2e-4);
    }

    // A step of 10 dB is followed in the frame that has it whole.
    void stepOfLevel()
    {
        for (const float factor : {3.1623f, 0.31623f}) {
            std::vector<float> samples = gaussian(60'000, 7);
            for (std::size_t i = 40'000; i < samples.size(); ++i)
                samples[i] *= factor;
            const CausalSpectrogram frames = causal(samples);
            const Index step = 40'000 / frames.spectrogram()->hopSamples();
            for (Index frame = step - 2; frame < step + 12; ++frame) {
                const double mean = meanOf(frames, frame, frame + 1, 4, 120);
                QVERIFY2(mean > 0.4 && mean < 1.5, (said(double(frame - step)) + ": " + said(mean)).constData());
            }
            for (Index frame = step; frame < step + 150; frame += 10) { // while the block fills with it
                const double after = meanOf(frames, frame, frame + 10, 4, 120);
                QVERIFY2(std::abs(after - 0.97) < 0.3, (said(double(frame - step)) + ": " + said(after)).constData());
            }
        }
    }

    // Noise that becomes another one, a step of colour within a sub-band: once a block of it was heard, its mean is 1.
    void newColourIsLearned()
    {
        std::vector<float> samples = gaussian(120'000, 8);
        float before = 0.0f;
        for (std::size_t i = 60'000; i < samples.size(); ++i)
            samples[i] = before = 0.6f * before + samples[i];
        const CausalSpectrogram frames = causal(samples);
        const Index from = (60'000 + Index(1.3 * blockWindows * windowSeconds * rate)) / 125;
        for (const Index bin : {10, 60, 110}) {
            const double mean = meanOf(frames, from, frames.time().count, bin - 6, bin + 6);
            QVERIFY2(std::abs(mean - 1.0) < 0.08, said(mean));
        }
    }

    // A line of y = 10 and its noise, less the margin; the mean over 20 runs, which scatters by 0.15 in the first block.
    void steadyLineKeepsItsLevel()
    {
        constexpr int runs = 20;
        const double amplitude = std::sqrt(6.0 * 10.0 / (windowSeconds * rate)); // of a Hann window, on a bin
        double early = 0.0;
        double late = 0.0;
        for (std::uint64_t run = 0; run < runs; ++run) {
            std::vector<float> samples = gaussian(60'000, 900 + run);
            for (std::size_t n = 0; n < samples.size(); ++n)
                samples[n] += float(amplitude * std::cos(2.0 * std::numbers::pi * 200.0 * double(n) / rate));
            const CausalSpectrogram frames = causal(samples);
            const Index bin = frames.grid().axes[0].nearest(200.0);
            early += meanOf(frames, 0, 90, bin, bin + 1) / runs;
            late += meanOf(frames, 200, 470, bin, bin + 1) / runs;
        }
        QVERIFY2(early > 9.9 && early < 11.0, said(early));
        QVERIFY2(late > 10.4 && late < 11.3, said(late));
    }

    void silenceIsNoNoise()
    {
        std::vector<float> samples = gaussian(100'000, 10);
        std::fill_n(samples.begin() + 30'000, 40'000, 0.0f);
        const CausalSpectrogram frames = causal(samples);
        const std::vector<float> silent = readFrames(frames, 250, 300);
        QVERIFY(std::all_of(silent.begin(), silent.end(), [](float value) { return value == 0.0f; }));
        const double after = meanOf(frames, 561, 780, 4, 120); // as if it had never been
        QVERIFY2(std::abs(after - 1.0) < 0.05, said(after));
        std::fill_n(samples.begin(), 30'000,
                    0.0f); // silent from the beginning on: nothing before there is a quarter of a block
        const CausalSpectrogram late = causal(samples);
        const std::vector<float> nothing = readFrames(late, 0, 560);
        QVERIFY(std::all_of(nothing.begin(), nothing.end(), [](float value) { return value == 0.0f; }));
        const double begun = meanOf(late, 600, 780, 4, 120);
        QVERIFY2(begun > 0.8 && begun < 1.05, said(begun));
    }

    void tornFramesAreNotObserved()
    {
        const auto recording = std::make_shared<MemoryRecording>(gaussian(60'000, 11), rate);
        recording->leaveOut(40'001, 1000);
        const CausalSpectrogram frames = causal(recording);
        const Index cells = frames.grid().size();
        for (Index frame = 300; frame < 340; ++frame) {
            const std::vector<float> y = readFrames(frames, frame, 1);
            const Index first = frame * frames.spectrogram()->hopSamples();
            const bool isTorn = first < 41'001 && first + 250 > 40'001;
            QCOMPARE(std::count_if(y.begin(), y.end(), [](float value) { return std::isnan(value); }),
                     isTorn ? cells : 0);
        }
    }

    void shorterThanABlock()
    {
        for (const Index samples : {250, 600, 5000}) {
            const CausalSpectrogram frames = causal(gaussian(samples, 12));
            const std::vector<float> y = readFrames(frames, 0, frames.time().count);
            QVERIFY(std::all_of(y.begin(), y.end(), [](float value) { return std::isfinite(value) && value >= 0.0f; }));
        }
        const double mean = meanOf(readFrames(causal(gaussian(5000, 12)), 0, 39));
        QVERIFY2(mean > 0.7 && mean < 1.1, said(mean));
    }

    // Of a series of chance the mean counts, of a step all.
    void latestLevel()
    {
        std::vector<float> series(256, 0.5f);
        QVERIFY(std::abs(latestBeyondScatter(series, 0.1) - 0.5f) < 1e-6f);
        series.back() = 0.6f; // one standard error
        QVERIFY(std::abs(latestBeyondScatter(series, 0.1) - (0.5f + 0.1f / 128.0f)) < 1e-5f);
        series.back() = 5.5f;
        QVERIFY(std::abs(latestBeyondScatter(series, 0.1) - 5.5f) < 0.05f);
        double square = 0.0;
        for (std::uint64_t run = 0; run < 400; ++run) {
            std::vector<float> noise(256);
            Random(9, run).normals(noise, 0.1f);
            const auto level = double(latestBeyondScatter(noise, 0.1));
            square += level * level / 400.0;
        }
        QVERIFY2(std::sqrt(square) < 0.045, said(std::sqrt(square))); // a mean of 128 alone: 0.009
        QVERIFY2(std::sqrt(square) > 0.008, said(std::sqrt(square)));
    }
};

FAINTLINE_TEST(tst_CausalSpectrogram)
#include "tst_CausalSpectrogram.moc"
