#include "app/cli/speed/SpeedKernel.h"

#include "app/cli/speed/plainForms.h"
#include "base/Error.h"
#include "base/LargeVector.h"
#include "base/Random.h"
#include "detect/Smd.h"
#include "model/sonarModels.h"
#include "spectrum/NoiseNormaliser.h"
#include "spectrum/medians.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

namespace faintline {

namespace {

    const std::string ours = "faintline";
    const std::string twoThreads = "two threads";
    const std::string formula = "formula";
    const std::string eigen = "Eigen";
    const std::string pass = "pass";

    std::vector<float> exponentials(std::size_t n)
    {
        std::vector<float> values(n);
        Random(1, 0).exponentials(values);
        return values;
    }

    /// A detector on frames that come round again.
    template <class D>
    class Running
    {
    public:
        Running(D detector, Index cells, Index frames)
            : m_detector(std::move(detector)), m_cells(std::size_t(cells)), m_frames(std::size_t(frames)),
              m_y(exponentials(m_cells * m_frames)), m_statistic(m_y.size())
        {
            oneByOne();
        }

        void oneByOne()
        {
            for (std::size_t i = 0; i < m_frames; ++i)
                m_detector.update(std::span<const float>(m_y).subspan(i * m_cells, m_cells),
                                  std::span(m_statistic).subspan(i * m_cells, m_cells));
        }

        void atOnce() { m_detector.updateBlock(m_y, m_statistic, Index(m_cells)); }

    private:
        D m_detector;
        std::size_t m_cells;
        std::size_t m_frames;
        std::vector<float> m_y;
        std::vector<float> m_statistic;
    };

    template <class D>
    SpeedForm running(const std::string &name, D detector, const StateSpace &space, Index frames, bool atOnce = false,
                      int threads = 1)
    {
        const auto it = std::make_shared<Running<D>>(std::move(detector), space.cellCount(), frames);
        std::function<void()> run = [it] { it->oneByOne(); };
        if constexpr (requires(D d) { d.updateBlock({}, {}, 0); })
            if (atOnce)
                run = [it] { it->atOnce(); };
        return {name, double(space.stateCount() * frames), threads, run};
    }

    SpeedForm smd(const std::string &name, const MarkovModel &model, Index frames, double lnK, int threads = 1)
    {
        Smd detector(model, {ResetLaw::Fixed, lnK});
        detector.useThreads(threads);
        return running(name, std::move(detector), model.space, frames, true, threads);
    }

    SpeedForm passOver(const StateSpace &space)
    {
        const std::vector<float> some = exponentials(std::size_t(space.stateCount()));
        const auto values = std::make_shared<LargeVector<float>>(some.begin(), some.end());
        return {pass, double(space.stateCount()), 1, [values] { sweep(*values); }};
    }

    // ---- one axis --------------------------------------------------------------------------------------------------

    constexpr Index blockFrames = 16;

    MarkovModel slopes(int count, Index cells)
    {
        const double third = 1.0 / 3.0;
        return {StateSpace({KinematicAxis{"frequency", cells, false, -(count - 1) / 2, count, {third, third}, {}}}),
                Likelihood(LikelihoodKind::Linear), 1.0};
    }

    /// Above it the mean of λ + ln K + ln h is negative: scores neither grow without bound nor vanish.
    constexpr double slopesLnK = -1.0;

    std::vector<SpeedForm> slopeForms(int count, Index cells)
    {
        const MarkovModel model = slopes(count, cells);
        return {smd(ours, model, blockFrames, slopesLnK),
                running(formula, FormulaRecursion(model.space, slopesLnK), model.space, 1),
                running(eigen, EigenRecursion(model.space, float(slopesLnK)), model.space, 2),
                passOver(model.space),
                running("frame by frame", Smd(model, {ResetLaw::Fixed, slopesLnK}), model.space, blockFrames),
                smd(twoThreads, model, blockFrames, slopesLnK, 2)};
    }

    /// Largest difference between the statistics of a detector and of the formula over some frames.
    double difference(const MarkovModel &model, double lnK, Index frames)
    {
        const auto cells = std::size_t(model.space.cellCount());
        const std::vector<float> y = exponentials(cells * std::size_t(frames));
        std::vector<float> found(y.size());
        std::vector<float> expected(cells);
        Smd detector(model, {ResetLaw::Fixed, lnK});
        detector.updateBlock(y, found, model.space.cellCount());
        FormulaRecursion plain(model.space, lnK);
        double largest = 0.0;
        for (std::size_t frame = 0; frame < std::size_t(frames); ++frame) {
            plain.update(std::span<const float>(y).subspan(frame * cells, cells), expected);
            for (std::size_t cell = 0; cell < cells; ++cell)
                largest = std::max(largest, double(std::abs(found[frame * cells + cell] - expected[cell])));
        }
        return largest;
    }

    SpeedCheck sameAsFormula(const MarkovModel &small, double lnK)
    {
        return {"largest difference from the formula over 40 frames, nat", 1e-4,
                [small, lnK] { return difference(small, lnK, 40); }};
    }

    // ---- two axes --------------------------------------------------------------------------------------------------

    constexpr Index sonarFrames = 8;

    MarkovModel sonar(const SonarMotion &motion, Index ranges)
    {
        const Grid grid{{{"range", "m", 0.0, 1.0, ranges, false}, {"bearing", "deg", 0.0, 18.0, 20, true}}};
        return sonarModel(grid, motion);
    }

    double sonarLnK(const SonarMotion &motion)
    {
        return motion.rangeRateChange.size() > 1 ? -0.5 : -1.386;
    }

    std::vector<SpeedForm> sonarForms(const SonarMotion &motion, bool withFormula)
    {
        const MarkovModel model = sonar(motion, 2500);
        const double lnK = sonarLnK(motion);
        std::vector<SpeedForm> forms{
            smd(ours, model, sonarFrames, lnK), running(eigen, EigenRecursion(model.space, float(lnK)), model.space, 1),
            passOver(model.space),
            running("frame by frame", Smd(model, {ResetLaw::Fixed, lnK}), model.space, sonarFrames),
            smd(twoThreads, model, sonarFrames, lnK, 2)};
        if (withFormula)
            forms.push_back(running(formula, FormulaRecursion(model.space, lnK), model.space, 1));
        return forms;
    }

    std::vector<SpeedForm> sizes(const std::string &small, const MarkovModel &few, const std::string &large,
                                 const MarkovModel &many, Index frames, double lnK)
    {
        const Index more = std::max<Index>(1, many.space.stateCount() / few.space.stateCount() / 8);
        return {smd(large, many, frames, lnK), smd(small, few, frames * more, lnK), passOver(many.space)};
    }

    // ---- evidence, spectra, background, noise ------------------------------------------------------------------------

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

    class NoiseInMemory final : public Recording
    {
    public:
        explicit NoiseInMemory(std::size_t samples) : m_samples(samples)
        {
            Random(2, 0).normals(m_samples, 1.0f);
            m_info.path = "noise";
            m_info.sampleRateHz = 48000.0;
            m_info.sampleCount = std::ssize(m_samples);
            m_info.channelCount = 1;
        }
        void read(int, Index first, Index count, std::span<float> out) const override
        {
            fill(first, count, out, [this](Index from, std::span<float> inside) {
                std::copy_n(m_samples.begin() + from, inside.size(), inside.begin());
            });
        }

    private:
        std::vector<float> m_samples;
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
        const auto recording = std::make_shared<NoiseInMemory>(std::size_t(length) * 80);
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

    std::vector<SpeedKernel> makeKernels()
    {
        return {
            {"recursion-21",
             "one axis, 21 slopes, 100 000 cells",
             "state",
             {{ours, formula, 12.0}, {ours, eigen, 4.0}, {ours, pass, 1.3}, {twoThreads, ours, 1.5}},
             [] { return slopeForms(21, 100'000); },
             {sameAsFormula(slopes(21, 3000), slopesLnK)}},
            {"recursion-5",
             "one axis, 5 slopes, 100 000 cells",
             "state",
             {{ours, formula, 10.0}, {ours, eigen, 5.0}, {twoThreads, ours, 1.5}},
             [] { return slopeForms(5, 100'000); },
             {sameAsFormula(slopes(5, 3000), slopesLnK)}},
            {"recursion-large",
             "one axis, 21 slopes, 21 million states",
             "state",
             {{"21 M states", "0.2 M states", 0.75}, {"21 M states", pass, 1.3}},
             [] {
                 return sizes("0.2 M states", slopes(21, 10'000), "21 M states", slopes(21, 1'000'000), blockFrames,
                              slopesLnK);
             }},
            {"sonar-27",
             "two axes, 27 transitions, 6.15 million states",
             "state",
             {{ours, formula, 40.0}, {ours, eigen, 4.0}, {ours, pass, 0.25}, {twoThreads, ours, 1.6}},
             [] { return sonarForms(manoeuvring(), true); },
             {sameAsFormula(sonar(manoeuvring(), 150), sonarLnK(manoeuvring()))}},
            {"sonar-1",
             "two axes, one-to-one, 6.15 million states",
             "state",
             {{ours, eigen, 2.5}, {ours, pass, 1.0}, {twoThreads, ours, 1.5}},
             [] { return sonarForms(nonManoeuvring(), false); },
             {sameAsFormula(sonar(nonManoeuvring(), 150), sonarLnK(nonManoeuvring()))}},
            {"sonar-large",
             "two axes, 27 transitions, 24.6 million states",
             "state",
             {{"24.6 M states", "3 M states", 0.85}, {"24.6 M states", pass, 0.25}},
             [] {
                 return sizes("3 M states", sonar(manoeuvring(), 1250), "24.6 M states", sonar(manoeuvring(), 10'000),
                              2, sonarLnK(manoeuvring()));
             }},
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
            {"background-mean",
             "mean over neighbouring bins",
             "bin",
             {{"257 bins", "33 bins", 1.0 / 1.3}},
             runningMeanForms},
            {"background-median",
             "median of each cell over 48 frames",
             "cell",
             {{ours, "nth_element", 5.0}},
             medianForms},
            {"sum-product", "sum-product, radar of 900 cells", "state", {{ours, "dense", 8.0}}, sumProductForms},
            {"noise", "normal random numbers", "number", {{ours, "std::normal_distribution", 8.0}}, noiseForms},
        };
    }

} // namespace

const std::vector<SpeedKernel> &speedKernels()
{
    static const std::vector<SpeedKernel> kernels = makeKernels();
    return kernels;
}

std::vector<SpeedKernel> speedKernels(const std::string &name)
{
    std::vector<SpeedKernel> chosen;
    std::string names;
    for (const SpeedKernel &kernel : speedKernels()) {
        if (name == "all" || kernel.name == name || kernel.name.starts_with(name + "-"))
            chosen.push_back(kernel);
        names += ", " + kernel.name;
    }
    if (chosen.empty())
        throw Error("bench " + name, "unknown kernel; choose one of all" + names);
    return chosen;
}

} // namespace faintline
