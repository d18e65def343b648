#include "app/cli/speed/kernels.h"

#include "analyse/analyse.h"
#include "app/cli/speed/SpeedKernel.h"
#include "app/cli/speed/plainForms.h"
#include "base/Random.h"
#include "detect/Smd.h"
#include "model/Likelihood.h"
#include "noise/NoiseNormaliser.h"
#include "noise/medians.h"
#include "recursion/Recursion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>

namespace faintline {

namespace {

    const char *const bare = "FFTW and states";
    const char *const eachWindow = "each window";

    std::vector<SpeedForm> likelihoodForms()
    {
        constexpr std::size_t n = 1 << 16;
        struct Work {
            Likelihood rice{LikelihoodKind::Rice, 0.5};
            std::vector<float> y = exponentials(n);
            std::vector<float> out = std::vector<float>(n);
            double sum = 0.0;
        };
        const auto work = std::make_shared<Work>();
        return {{ours, n, 1, [work] { work->rice.apply(work->y, work->out); }},
                {"scalar Bessel", n / 64, 1, [work] {
                     for (std::size_t i = 0; i < n; i += 64)
                         work->sum += work->rice.at(double(work->y[i]));
                 }}};
    }

    double riceError()
    {
        const Likelihood rice(LikelihoodKind::Rice, 0.5);
        std::vector<float> y;
        for (double value = 1e-4; value < 100.0; value *= 1.001)
            y.push_back(float(value));
        std::vector<float> out(y.size());
        rice.apply(y, out);
        double largest = 0.0;
        for (std::size_t i = 0; i < y.size(); ++i)
            largest = std::max(largest, std::abs(double(out[i]) - rice.at(double(y[i]))));
        return largest;
    }

    /// Noise at 48 kHz; as 16-bit samples, half an hour of it takes 170 MB.
    template <class Sample>
    class NoiseInMemory final : public Recording
    {
    public:
        explicit NoiseInMemory(Index samples)
        {
            m_info.path = "noise";
            m_info.sampleRateHz = 48000.0;
            m_info.sampleCount = samples;
            m_info.channelCount = 1;
            std::vector<float> part(48000);
            for (std::uint64_t i = 0; std::ssize(m_samples) < samples; ++i) {
                Random(5, i).normals(part, 3000.0f);
                const Index count = std::min(std::ssize(part), samples - std::ssize(m_samples));
                m_samples.insert(m_samples.end(), part.begin(), part.begin() + count); // 32767 is eleven deviations
            }
        }
        void read(int, Index first, Index count, std::span<float> out) const override
        {
            fill(first, count, out, [this](Index from, std::span<float> inside) {
                std::copy_n(m_samples.begin() + from, inside.size(), inside.begin());
            });
        }

    private:
        std::vector<Sample> m_samples;
    };

    std::vector<SpeedForm> spectrogramForms(int length)
    {
        SpectrogramSettings settings;
        settings.windowSeconds = length / 48000.0;
        settings.binsPerCell = 1;
        struct Work {
            std::shared_ptr<const Spectrogram> spectrogram;
            std::shared_ptr<const NormalisedSpectrogram> normalised;
            std::shared_ptr<Fft> fft;
            std::unique_ptr<Fft::Buffer> buffer;
            std::vector<float> out;
        };
        const auto work = std::make_shared<Work>();
        constexpr Index frames = 64;
        const auto recording = std::make_shared<NoiseInMemory<float>>(Index(length) * 80);
        work->spectrogram = std::make_shared<Spectrogram>(recording, settings);
        const NormaliserSettings noise;
        work->normalised = std::make_shared<NormalisedSpectrogram>(
            work->spectrogram, estimateBackground(*work->spectrogram, noise), noise);
        work->fft = std::make_shared<Fft>(length, Fft::Input::Real);
        work->buffer = work->fft->buffer();
        work->out.resize(std::size_t(frames * work->spectrogram->frequency().count));
        RunContext two;
        two.threads = 2;
        return {{ours, frames, 1, [work] { work->spectrogram->read(0, frames, work->out); }},
                {"bare FFTW", frames, 1,
                 [work] {
                     for (Index i = 0; i < frames; ++i)
                         work->fft->run(*work->buffer);
                 }},
                {"normalised", frames, 1, [work] { work->normalised->read(0, frames, work->out); }},
                {twoThreads, frames, 2, [work, two] { work->spectrogram->read(0, frames, work->out, two); }}};
    }

    /// Of the transform of a frame.
    int lengthOf(const FrameGeometry &geometry)
    {
        return Fft::fastLength(int(std::lround(geometry.binsPerCell * geometry.windowSamples)));
    }

    /// Half an hour of noise in windows of 2 s, against its transforms and its states alone.
    std::vector<SpeedForm> detectionForms()
    {
        constexpr std::size_t framesAtOnce = 16;
        struct Work {
            explicit Work(const Analysis &analysis)
                : fft(lengthOf(analysis.frames->geometry()), Fft::Input::Real), buffer(fft.buffer()),
                  detector(analysis.model, {ResetLaw::Fixed, analysis.calibration->lnK}), cells(analysis.grid().size()),
                  y(exponentials(framesAtOnce * std::size_t(cells))), statistic(y.size())
            {
            }
            Fft fft;
            std::unique_ptr<Fft::Buffer> buffer;
            Smd detector;
            Index cells;
            std::vector<float> y;
            std::vector<float> statistic;
        };
        constexpr AnalysisDepth tracks = AnalysisDepth::Tracks;
        const OpenedSource noise(std::make_shared<NoiseInMemory<std::int16_t>>(1800 * 48000));
        AnalysisSettings settings;
        settings.spectrogram.windowSeconds = 2.0;
        const auto detect = [=] { return analyse(noise, settings, {.depth = tracks}); };
        const std::shared_ptr<const Analysis> analysis = detect();
        const auto work = std::make_shared<Work>(*analysis);
        return {{ours, double(analysis->time().count), 1, [=] { detect(); }},
                {bare, framesAtOnce, 1, [work] {
                     for (std::size_t i = 0; i < framesAtOnce; ++i)
                         work->fft.run(*work->buffer);
                     work->detector.updateBlock(work->y, work->statistic, work->cells);
                 }}};
    }

    /// Five minutes of it with the window left open, against the detection in each of the windows that were tried.
    std::vector<SpeedForm> windowForms()
    {
        const OpenedSource noise(std::make_shared<NoiseInMemory<std::int16_t>>(300 * 48000));
        const auto detect = [noise](const AnalysisSettings &settings) {
            return analyse(noise, settings, {.depth = AnalysisDepth::Tracks});
        };
        std::vector<AnalysisSettings> windows;
        const std::shared_ptr<const Analysis> analysis = detect({});
        for (const WindowTrial &trial : analysis->choice->trials) {
            windows.push_back(trial.settings);
            windows.back().spectrogram.windowSeconds = trial.windowSeconds;
        }
        return {{ours, 1, 1, [detect] { detect({}); }}, {eachWindow, 1, 1, [detect, windows] {
                                                             for (const AnalysisSettings &settings : windows)
                                                                 detect(settings);
                                                         }}};
    }

    std::vector<SpeedForm> runningMeanForms()
    {
        constexpr Index n = 8192;
        struct Work {
            std::vector<double> weights = std::vector<double>(n, 1.0);
            std::vector<double> mean = std::vector<double>(n);
            std::vector<double> values;
        };
        const auto work = std::make_shared<Work>();
        for (float value : exponentials(n))
            work->values.push_back(double(value));
        const auto over = [work](Index half) {
            return [work, half] { runningMean(work->values, work->weights, half, work->mean); };
        };
        return {{"257 bins", n, 1, over(128)}, {"33 bins", n, 1, over(16)}};
    }

    std::vector<SpeedForm> medianForms()
    {
        constexpr Index rows = 48;
        constexpr Index cells = 4096;
        struct Work {
            std::vector<float> frames = exponentials(std::size_t(rows * cells));
            std::vector<float> out = std::vector<float>(std::size_t(cells));
        };
        const auto work = std::make_shared<Work>();
        return {{ours, cells, 1, [work] { columnMedians(work->frames, work->out); }},
                {"nth_element", cells, 1, [work] {
                     std::vector<float> column(rows);
                     for (std::size_t cell = 0; cell < work->out.size(); ++cell) {
                         for (std::size_t row = 0; row < column.size(); ++row)
                             column[row] = work->frames[row * work->out.size() + cell];
                         std::nth_element(column.begin(), column.begin() + (rows - 1) / 2, column.end());
                         work->out[cell] = column[(rows - 1) / 2];
                     }
                 }}};
    }

    std::vector<SpeedForm> sumProductForms()
    {
        const auto walk = [](const char *name, Index cells) {
            return KinematicAxis{name, cells, false, 0, 1, {1.0}, {1.0, 1.0}, Rounding::HalfDown, true};
        };
        const StateSpace space({walk("azimuth", 3), walk("elevation", 3), walk("range", 100)});
        struct Work {
            explicit Work(const StateSpace &s) : recursion(s), dense(s), weights(std::size_t(s.stateCount()), 1.0) {}
            Recursion<SumProduct> recursion;
            DenseSumProduct dense;
            std::vector<double> weights;
        };
        const auto work = std::make_shared<Work>(space);
        const auto states = double(space.stateCount());
        return {{ours, states, 1, [work] { work->recursion.predict(work->weights); }},
                {"dense", states, 1, [work] {
                     std::vector<double> weights = work->weights;
                     work->dense.update(weights);
                 }}};
    }

    std::vector<SpeedForm> noiseForms()
    {
        constexpr std::size_t n = 1 << 16;
        struct Work {
            Random random{3, 0};
            std::mt19937 engine{3};
            std::normal_distribution<float> normal;
            std::vector<float> out = std::vector<float>(n);
        };
        const auto work = std::make_shared<Work>();
        return {{ours, n, 1, [work] { work->random.normals(work->out, 1.0f); }},
                {"std::normal_distribution", n, 1, [work] {
                     for (float &value : work->out)
                         value = work->normal(work->engine);
                 }}};
    }

} // namespace

std::vector<SpeedKernel> signalKernels()
{
    return {
        {"likelihood",
         "log-likelihood ratio, Rice",
         "cell",
         {{ours, "scalar Bessel", 10.0}},
         likelihoodForms,
         {{"largest error for y up to 100, nat", 1e-5, riceError}}},
        {"spectrogram-4096",
         "half-overlapping windows of 4096 samples",
         "frame",
         {{ours, "bare FFTW", 0.6}, {"normalised", ours, 0.5}, {twoThreads, ours, 1.8}},
         [] { return spectrogramForms(4096); }},
        {"spectrogram-16384",
         "half-overlapping windows of 16384 samples",
         "frame",
         {{ours, "bare FFTW", 0.75}, {"normalised", ours, 0.5}, {twoThreads, ours, 1.8}},
         [] { return spectrogramForms(16384); }},
        {"detection-window",
         "half an hour of noise at 48 kHz, windows of 2 s",
         "frame",
         {{ours, bare, 0.5}},
         detectionForms},
        {"detection-defaults",
         "five minutes of noise at 48 kHz, no settings",
         "recording",
         {{ours, eachWindow, 1.0 / 1.5}},
         windowForms},
        {"background-mean",
         "mean over neighbouring bins",
         "bin",
         {{"257 bins", "33 bins", 1.0 / 1.3}},
         runningMeanForms},
        {"background-median", "median of each cell over 48 frames", "cell", {{ours, "nth_element", 5.0}}, medianForms},
        {"sum-product", "sum-product, radar of 900 cells", "state", {{ours, "dense", 8.0}}, sumProductForms},
        {"noise", "normal random numbers", "number", {{ours, "std::normal_distribution", 8.0}}, noiseForms},
    };
}

} // namespace faintline
