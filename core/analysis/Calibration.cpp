#include "analysis/Calibration.h"

#include "analysis/CalibrationStore.h"
#include "analysis/knownCalibration.h"
#include "analysis/chain.h"
#include "base/Error.h"
#include "base/Random.h"
#include "recording/SimulatedRecording.h"
#include "spectrum/NoiseNormaliser.h"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <numeric>

namespace faintline {

namespace {

    constexpr int settlingFrames = 300;
    constexpr int regulationFrames = 1500;
    constexpr int windowSamples = 256; ///< of the simulated recording; its noise does not depend on it
    constexpr int segmentWindows = 4096;
    constexpr std::size_t levelCount = 2000;
    constexpr double levelsInView = 300.0; ///< of them, below the largest statistic of the first frames
    constexpr Index framesAtOnce = 64;
    constexpr Index blockFrames = 128;
    constexpr Index blockCells = 64;
    constexpr std::size_t leastMaxima = 40;
    /// Block maxima above the thresholds where events are counted, per cell and frame; clustering and inhibition leave a quarter of them as
    /// events. A tail that splitting follows is counted where events crowd each other out, in a tenth of the noise, and where they do not
    /// (800 and 400 events in the usual 8·10⁷ cells × frames). One that is continued along a line is counted at two thresholds far apart.
    constexpr std::array<double, 2> ratesBeforeSplitting{1e-3, 2e-5};
    constexpr std::array<double, 2> ratesOfLine{2e-5, 2.5e-6};
    constexpr int crowdedEvery = 10; ///< segments
    constexpr double leastExpected = 300.0; ///< maxima at 2·10⁻⁵, of which a line takes a third; in small volumes the rates are higher
    constexpr double leastEvents = 20.0;

    /// What a calibration may cost.
    struct Effort {
        double cellFrames = 0.0; ///< noise in which events are counted
        SplittingSettings splitting{};
        int pieceWindowSamples = 32; ///< of the band that splitting goes on in
        bool isFirstEstimate = false;
    };

    Effort effortOf(CalibrationDepth depth)
    {
        if (depth == CalibrationDepth::Refined)
            return {8e7};
        SplittingSettings fewer;
        fewer.entries = 1000;
        fewer.pilots = 60;
        fewer.leastLnRate = -21.0;
        return {1.6e7, fewer, 16, true};
    }

    /// Noise to calibrate on, in segments that can be made independently of each other.
    using NoiseSegment = std::function<NormalisedFramesPointer(int segment)>;

    /// Of so many segments, those that a rough look is taken at first.
    int roughCountOf(int segmentCount)
    {
        return std::max(2, segmentCount / 10);
    }

    /// The same segments, of which those of the rough look, gone through again and again, are made once.
    NoiseSegment remembered(NoiseSegment segment, int segmentCount)
    {
        struct Made {
            std::once_flag once;
            NormalisedFramesPointer frames;
        };
        const auto made = std::make_shared<std::vector<Made>>(static_cast<std::size_t>(roughCountOf(segmentCount)));
        return [segment = std::move(segment), made](int number) {
            if (number >= std::ssize(*made))
                return segment(number);
            Made &own = (*made)[static_cast<std::size_t>(number)];
            std::call_once(own.once, [&] { own.frames = segment(number); });
            return own.frames;
        };
    }

    /// Levels at which a statistic's exceedance is counted.
    struct Levels {
        float lowest = 0.0f;
        float step = 1.0f;
    };

    /// What a detector that nothing is kept from does.
    struct Tail {
        std::vector<double> counts = std::vector<double>(levelCount, 0.0); ///< cells per level bin
        std::vector<float> blockMaxima;
        double cellFrames = 0.0;
    };

    /// What chains with their thresholds do.
    struct EventCounts {
        std::vector<double> events; ///< of each chain …
        std::vector<double> cellFrames; ///< … and in how much noise
    };

    double countedCellFrames(const NormalisedFrames &noise)
    {
        return static_cast<double>(noise.grid().size() * std::max<Index>(0, noise.time().count - settlingFrames));
    }

    /// Calls take(frame, y) for every frame.
    template <class Take>
    void forEachFrame(const NormalisedFrames &noise, Take take)
    {
        const auto cells = static_cast<std::size_t>(noise.grid().size());
        std::vector<float> batch(framesAtOnce * cells);
        for (Index first = 0; first < noise.time().count; first += framesAtOnce) {
            const Index count = std::min(framesAtOnce, noise.time().count - first);
            noise.read(first, count, std::span(batch).first(static_cast<std::size_t>(count) * cells));
            for (Index i = 0; i < count; ++i)
                take(first + i, std::span<const float>(batch).subspan(static_cast<std::size_t>(i) * cells, cells));
        }
    }

    /// The frames from the start on, computed once for what goes through them many times.
    std::shared_ptr<const FrameArray> beginningOf(const NormalisedFrames &noise, Index frames)
    {
        Axis time = noise.time();
        time.count = std::min(time.count, frames);
        std::vector<float> values(static_cast<std::size_t>(time.count * noise.grid().size()));
        noise.read(0, time.count, values);
        return std::make_shared<FrameArray>(time, noise.grid(), std::move(values));
    }

    /// Fraction of states continued, and mean ln K, of one field of noise.
    ResetFit measureReset(const NormalisedFrames &noise, const MarkovModel &model, const ResetRule &rule)
    {
        Smd detector(model, rule);
        const auto cells = static_cast<std::size_t>(noise.grid().size());
        const Index frames = noise.time().count;
        std::vector<float> y(cells);
        std::vector<float> statistic(cells);
        double sum = 0.0;
        double sumLnK = 0.0;
        double counted = 0.0;
        for (Index frame = 0; frame < frames; ++frame) {
            noise.read(frame, 1, y);
            detector.update(y, statistic);
            if (frame < settlingFrames)
                continue;
            sum += detector.regulation().continuedFraction;
            sumLnK += detector.regulation().lnK;
            counted += 1.0;
        }
        return {sumLnK / counted, sum / counted};
    }

    ResetFit measureReset(const std::vector<NormalisedFramesPointer> &noise, const MarkovModel &model, const ResetRule &rule)
    {
        ResetFit mean;
        for (const NormalisedFramesPointer &field : noise) {
            const ResetFit fit = measureReset(*field, model, rule);
            mean.lnK += fit.lnK / static_cast<double>(noise.size());
            mean.continuedFraction += fit.continuedFraction / static_cast<double>(noise.size());
        }
        return mean;
    }

    /// ln K at which half of the states go on, by bisection: the fraction rises with K.
    double lnKForHalf(const std::vector<NormalisedFramesPointer> &noise, const MarkovModel &model)
    {
        constexpr double largest = 20.0;
        double low = -largest;
        double high = largest;
        while (high - low > 5e-4) {
            const double middle = 0.5 * (low + high);
            (measureReset(noise, model, {ResetLaw::Fixed, middle}).continuedFraction > 0.5 ? high : low) = middle;
        }
        const double end = low > -largest ? largest : -largest;
        const bool isInside = low > -largest && high < largest;
        const double percent = isInside ? 50.0 : 100.0 * measureReset(noise, model, {ResetLaw::Fixed, end}).continuedFraction;
        if (isInside || std::isnan(percent)) // of a few frames nothing is measured
            return 0.5 * (low + high);
        throw Error("model.snr = " + formatNumber(model.likelihood.snr()),
                    "leaves no ln K for which half of the states continue on noise: at " + formatNumber(end) + " nat "
                        + formatNumber(std::round(10.0 * percent) / 10.0) + " % do; choose a " + (end > 0.0 ? "lower" : "higher") + " one");
    }

    /// Levels that suit the statistic's own unit.
    Levels levelsOf(const NormalisedFrames &noise, Detector &detector)
    {
        const auto cells = static_cast<std::size_t>(noise.grid().size());
        std::vector<float> y(cells);
        std::vector<float> statistic(cells);
        float least = std::numeric_limits<float>::infinity();
        float largest = -least;
        for (Index frame = 0; frame < noise.time().count; ++frame) {
            noise.read(frame, 1, y);
            detector.update(y, statistic);
            if (frame < settlingFrames)
                continue;
            for (const float value : statistic)
                if (std::isfinite(value)) {
                    least = std::min(least, value);
                    largest = std::max(largest, value);
                }
        }
        if (!(least <= largest))
            return {}; // never decided anything
        return {least, std::max((largest - least) / static_cast<float>(levelsInView), 1e-6f)};
    }

    Tail measureTail(const NormalisedFrames &noise, Detector &detector, const Levels &levels)
    {
        const Index cells = noise.grid().size();
        const Index columns = std::max<Index>(1, cells / blockCells);
        std::vector<float> statistic(static_cast<std::size_t>(cells));
        std::vector<float> maxima(static_cast<std::size_t>(columns));
        Tail tail;
        Index inBlock = 0;
        forEachFrame(noise, [&](Index frame, std::span<const float> y) {
            detector.update(y, statistic);
            if (frame < settlingFrames)
                return;
            for (float value : statistic) {
                const float position = (value - levels.lowest) / levels.step;
                tail.counts[static_cast<std::size_t>(std::clamp(position, 0.0f, static_cast<float>(levelCount - 1)))] += 1.0;
            }
            if (inBlock == 0)
                std::fill(maxima.begin(), maxima.end(), -std::numeric_limits<float>::infinity());
            for (Index column = 0; column < columns; ++column) {
                const auto from = statistic.begin() + column * cells / columns;
                const auto to = statistic.begin() + (column + 1) * cells / columns;
                float &maximum = maxima[static_cast<std::size_t>(column)];
                maximum = std::max(maximum, *std::max_element(from, to));
            }
            if (++inBlock == blockFrames) {
                tail.blockMaxima.insert(tail.blockMaxima.end(), maxima.begin(), maxima.end());
                inBlock = 0;
            }
        });
        tail.cellFrames = countedCellFrames(noise);
        return tail;
    }

    void add(const Tail &part, Tail &whole)
    {
        std::transform(part.counts.begin(), part.counts.end(), whole.counts.begin(), whole.counts.begin(), std::plus<>());
        whole.blockMaxima.insert(whole.blockMaxima.end(), part.blockMaxima.begin(), part.blockMaxima.end());
        whole.cellFrames += part.cellFrames;
    }

    /// The chains' tracks after the settling frames; null chains count nothing.
    EventCounts countEvents(const NormalisedFrames &noise, const std::vector<std::unique_ptr<DetectionChain>> &chains)
    {
        std::vector<float> statistic(static_cast<std::size_t>(noise.grid().size()));
        forEachFrame(noise, [&](Index frame, std::span<const float> y) {
            for (const auto &chain : chains)
                if (chain)
                    chain->update(frame, y, statistic);
        });
        EventCounts counts;
        for (const auto &chain : chains) {
            double events = 0.0;
            if (chain) {
                chain->finish();
                events = static_cast<double>(std::count_if(chain->tracks().begin(), chain->tracks().end(), [](const Track &track) {
                    return track.detectFrame >= settlingFrames;
                }));
            }
            counts.events.push_back(events);
            counts.cellFrames.push_back(chain ? countedCellFrames(noise) : 0.0);
        }
        return counts;
    }

    void add(const EventCounts &part, EventCounts &whole)
    {
        whole.events.resize(part.events.size());
        whole.cellFrames.resize(part.events.size());
        std::transform(part.events.begin(), part.events.end(), whole.events.begin(), whole.events.begin(), std::plus<>());
        std::transform(part.cellFrames.begin(), part.cellFrames.end(), whole.cellFrames.begin(), whole.cellFrames.begin(), std::plus<>());
    }

    /// Calls work(number) for 0 … count-1, `threads` at a time, and take(result) in the order of the numbers.
    template <class Work, class Take>
    void inRounds(int count, const RunContext &context, Work work, Take take)
    {
        for (int done = 0; done < count;) {
            context.checkpoint(static_cast<double>(done) / count, "calibrating the threshold on noise");
            const int round = std::min(std::max(1, context.threads), count - done);
            std::vector<std::future<decltype(work(0))>> futures;
            for (int i = 0; i < round; ++i)
                futures.push_back(std::async(round > 1 ? std::launch::async : std::launch::deferred,
                                             [&work, number = done + i] { return work(number); }));
            for (auto &future : futures)
                take(future.get());
            done += round;
        }
    }

    /// Thresholds at which chains may be expected to find events at about the wanted rates, by a rough look at the maxima of space-time blocks: with P(max ≤ T) = exp(-Λ e^{-θ(T-u)}), Λ and θ from two quantiles.
    std::vector<double> thresholdsForEvents(std::vector<float> maxima, double cellFramesPerBlock, double cellFrames, bool isLine)
    {
        // A detector that decides in blocks of its own has blocks of ours without a decision.
        const auto blocks = static_cast<double>(maxima.size());
        std::erase_if(maxima, [](float maximum) { return !std::isfinite(maximum); });
        if (maxima.size() < leastMaxima)
            throw Error("detector", "decides too seldom to be calibrated on noise; choose a shorter window");
        std::sort(maxima.begin(), maxima.end());
        const double perMaximum = cellFramesPerBlock * blocks / static_cast<double>(maxima.size());
        constexpr double lower = 0.5;
        constexpr double upper = 0.95;
        const auto quantile = [&](double p) { return static_cast<double>(maxima[static_cast<std::size_t>(p * static_cast<double>(maxima.size()))]); };
        const double theta = std::log(std::log(lower) / std::log(upper)) / std::max(1e-6, quantile(upper) - quantile(lower));
        std::vector<double> thresholds;
        const double expected = isLine ? leastExpected / 3.0 : leastExpected;
        const double scale = std::max(1.0, expected / (ratesOfLine.front() * cellFrames));
        for (const double rate : isLine ? ratesOfLine : ratesBeforeSplitting)
            thresholds.push_back(quantile(upper) + std::log(-std::log(upper) / perMaximum / (rate * scale)) / theta);
        return thresholds;
    }

    /// Fits ln(rate) = ln(rate at the anchor) - θ(T - anchor) to Poisson counts of events at several thresholds, by maximum likelihood.
    void fitEventRate(std::span<const double> thresholds, std::span<const double> events, double cellFrames, Calibration &result)
    {
        const double total = std::accumulate(events.begin(), events.end(), 0.0);
        if (total < leastEvents)
            throw Error("detector", "hardly ever exceeds any threshold on noise, which leaves nothing to calibrate on");
        double anchor = 0.0; // where both parameters' errors are independent
        for (std::size_t i = 0; i < thresholds.size(); ++i)
            anchor += thresholds[i] * events[i] / total;
        const auto weights = [&](double theta) {
            std::vector<double> w;
            for (const double threshold : thresholds)
                w.push_back(std::exp(-theta * (threshold - anchor)));
            return w;
        };
        // With the rate at its best for each θ, the likelihood is that of a multinomial: Σ nᵢ ln(wᵢ/Σw), Σ nᵢ(Tᵢ - anchor) = 0.
        const auto minusLogLikelihood = [&](double theta) {
            const std::vector<double> w = weights(theta);
            return total * std::log(std::accumulate(w.begin(), w.end(), 0.0));
        };
        const double range = *std::max_element(thresholds.begin(), thresholds.end()) - *std::min_element(thresholds.begin(), thresholds.end());
        const double theta = boost::math::tools::brent_find_minima(minusLogLikelihood, 0.0, 40.0 / range, 40).first;
        const std::vector<double> w = weights(theta);
        const double sum = std::accumulate(w.begin(), w.end(), 0.0);
        double variance = 0.0;
        for (std::size_t i = 0; i < thresholds.size(); ++i)
            variance += w[i] / sum * (thresholds[i] - anchor) * (thresholds[i] - anchor);
        result.anchorNats = anchor;
        result.tailSlope = theta;
        result.slopeError = 1.0 / std::sqrt(total * variance);
        result.relativeError = 1.0 / std::sqrt(total);
        result.eventRate = total / sum / cellFrames;
    }

    void fillExceedance(const std::vector<double> &counts, const Levels &levels, Calibration &result)
    {
        const double total = std::accumulate(counts.begin(), counts.end(), 0.0);
        double above = total;
        for (std::size_t i = 0; i < counts.size() && above > 0.0; ++i) {
            result.levels.push_back(static_cast<double>(levels.lowest) + static_cast<double>(levels.step) * static_cast<double>(i));
            result.exceedance.push_back(above / total);
            above -= counts[i];
        }
    }

    /// How rare excursions of noise of known level are, on a small band that closes on itself, along which all cells are alike.
    RareRates followTail(const NormalisedFrames &frames, const MarkovModel &model, const AnalysisSettings &settings,
                         const Calibration &calibration, const Effort &effort, const RunContext &context)
    {
        constexpr Index pieceCells = 64;
        if (model.space.axes().size() > 1 || !model.space.axes().front().transition.empty())
            return {};
        KinematicAxis axis = model.space.axes().front();
        const bool isSpectral = dynamic_cast<const NormalisedSpectrogram *>(&frames) != nullptr;
        const Index independentCells = std::max<Index>(pieceCells, 8 * axis.largestDisplacement() + 1);
        const std::function<std::unique_ptr<NoiseStream>()> makeNoise = [&] {
            return isSpectral ? spectralNoise(settings.spectrogram, effort.pieceWindowSamples)
                              : independentNoise(independentCells);
        };
        axis.cells = makeNoise()->cells();
        axis.cyclic = true;
        if (axis.cells <= 4 * axis.largestDisplacement())
            return {};
        const MarkovModel piece{StateSpace({axis}), model.likelihood, model.transitionScale};
        const Grid grid{{{axis.name, "", 0.0, 1.0, axis.cells, true}}};
        const auto *smd = std::get_if<SmdSettings>(&settings.detector);
        const auto make = [&] {
            return makeDetector(settings.detector, piece, grid,
                                isSpectral ? frameGeometry(settings.spectrogram) : FrameGeometry{},
                                smd ? resetRule(*smd, calibration.lnK) : ResetRule{});
        };
        return measureRareRates(make, makeNoise, effort.splitting, context);
    }

    /// The first cells of another stream: a band whose ends paths run off.
    class BandNoise final : public NoiseStream
    {
    public:
        BandNoise(std::unique_ptr<NoiseStream> wide, Index cells)
            : m_wide(std::move(wide)), m_cells(cells), m_y(static_cast<std::size_t>(m_wide->cells()))
        {
        }
        Index cells() const override { return m_cells; }
        void next(Random &random, std::span<float> y) override
        {
            m_wide->next(random, m_y);
            std::copy_n(m_y.begin(), m_cells, y.begin());
        }
        std::vector<float> state() const override { return m_wide->state(); }
        void setState(std::span<const float> state) override { m_wide->setState(state); }

    private:
        std::unique_ptr<NoiseStream> m_wide;
        Index m_cells;
        std::vector<float> m_y;
    };

    /// As `followTail`, in so many bins with two ends, or in a band that closes on itself.
    RareRates followBand(const AnalysisSettings &bare, double lnK, Index bins, bool isCyclic, const SplittingSettings &splitting,
                         const RunContext &context)
    {
        constexpr int least = 32;
        int samples = least;
        while (!isCyclic && samples < bins) // twice as many bins and more, so that the ends do not meet
            samples *= 2;
        const auto makeNoise = [&]() -> std::unique_ptr<NoiseStream> {
            auto wide = spectralNoise(bare.spectrogram, samples);
            if (isCyclic)
                return wide;
            return std::make_unique<BandNoise>(std::move(wide), bins);
        };
        const Grid grid{{{"frequency", "Hz", 0.0, 1.0, makeNoise()->cells(), isCyclic}}};
        const MarkovModel model = makeModel(bare.model, grid);
        if (isCyclic && grid.size() <= 4 * model.space.axes().front().largestDisplacement())
            return {};
        const auto *smd = std::get_if<SmdSettings>(&bare.detector);
        const auto make = [&] {
            return makeDetector(bare.detector, model, grid, frameGeometry(bare.spectrogram), smd ? resetRule(*smd, lnK) : ResetRule{});
        };
        return measureRareRates(make, makeNoise, splitting, context);
    }

    /// Where a narrow band's rate is known, that of one in which its ends take away a `share` of that.
    std::shared_ptr<const Calibration> withShareOfEnds(const Calibration &wide, const Calibration &narrow, double share)
    {
        auto result = std::make_shared<Calibration>(narrow);
        RareRates &rates = result->rates;
        for (std::size_t i = 0; i < rates.levels.size(); ++i) {
            const double left = std::exp(narrow.rates.lnRates[i] - wide.rates.lnRates[i]);
            rates.lnRates[i] = wide.rates.lnRates[i] + std::log(1.0 - share * (1.0 - left));
            rates.relativeErrors[i] =
                wide.rates.relativeErrors[i] + share * (narrow.rates.relativeErrors[i] - wide.rates.relativeErrors[i]);
        }
        const std::size_t before = rates.levels.size() - std::min<std::size_t>(4, rates.levels.size());
        result->eventRate = std::exp(rates.lnRateAt(result->anchorNats));
        result->relativeError = rates.relativeErrorAt(result->anchorNats);
        result->tailSlope = (rates.lnRates[before] - rates.lnRates.back()) / (rates.levels.back() - rates.levels[before]);
        return result;
    }

    /// A wide band's calibration with what a narrow one's ends take away.
    std::shared_ptr<const Calibration> narrowed(const Calibration &wide, const RareRates &band, const RareRates &closed)
    {
        Calibration narrow = wide;
        RareRates &rates = narrow.rates;
        for (std::size_t i = 0; i < rates.levels.size(); ++i) {
            const double level = rates.levels[i];
            rates.lnRates[i] += std::min(0.0, band.lnRateAt(level) - closed.lnRateAt(level));
            rates.relativeErrors[i] =
                std::hypot(rates.relativeErrors[i], std::hypot(band.relativeErrorAt(level), closed.relativeErrorAt(level)));
        }
        return withShareOfEnds(wide, narrow, 1.0);
    }

    /// The tail of the chain's events: the shape is that of excursions, ln S(T), the height that of the counts,
    ///
    ///   ln rate(T) = ln S(T) + δ(T),   δ = ln(events/noise) - ln S at the thresholds, linear between them, constant beyond.
    void anchorTail(const RareRates &rare, std::span<const double> thresholds, const EventCounts &counts, Calibration &result)
    {
        std::vector<double> levels; // where there are enough events to tell, ascending
        std::vector<double> offsets;
        double events = 0.0;
        for (std::size_t i = 0; i < thresholds.size(); ++i) {
            if (counts.events[i] < leastEvents)
                continue;
            events = counts.events[i];
            levels.push_back(thresholds[i]);
            offsets.push_back(std::log(events / counts.cellFrames[i]) - rare.lnRateAt(thresholds[i]));
        }
        if (levels.empty())
            throw Error("detector", "hardly ever exceeds any threshold on noise, which leaves nothing to calibrate on");
        const auto offset = [&](double level) {
            if (levels.size() == 1)
                return offsets.front();
            const double fraction = std::clamp((level - levels.front()) / (levels.back() - levels.front()), 0.0, 1.0);
            return offsets.front() + fraction * (offsets.back() - offsets.front());
        };
        const double anchor = levels.back();
        const double own = 1.0 / std::sqrt(events);
        const double known = rare.relativeErrorAt(anchor);
        std::vector<double> knots = rare.levels;
        knots.insert(knots.end(), levels.begin(), levels.end());
        std::sort(knots.begin(), knots.end());
        knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
        for (const double level : knots) {
            const double error = rare.relativeErrorAt(level);
            result.rates.levels.push_back(level);
            result.rates.lnRates.push_back(rare.lnRateAt(level) + offset(level));
            result.rates.relativeErrors.push_back(std::hypot(own, std::sqrt(std::max(0.0, error * error - known * known))));
        }
        const RareRates &rates = result.rates;
        const std::size_t before = knots.size() - std::min<std::size_t>(4, knots.size());
        result.anchorNats = anchor;
        result.eventRate = std::exp(rates.lnRateAt(anchor));
        result.relativeError = own;
        result.tailSlope = (rates.lnRates[before] - rates.lnRates.back()) / (knots.back() - knots[before]);
        result.slopeError = rates.relativeErrors.back() / std::max(1.0, knots.back() - anchor);
    }

    std::shared_ptr<const Calibration> calibrateOn(const NoiseSegment &segment, int segmentCount, const MarkovModel &model,
                                                   const AnalysisSettings &settings, const Effort &effort, const RunContext &context)
    {
        // The analysis whose chain will be asked, with thresholds to be found.
        Analysis trial;
        trial.settings = settings;
        trial.model = model;
        auto result = std::make_shared<Calibration>();
        result->isFirstEstimate = effort.isFirstEstimate;
        trial.calibration = result;
        context.checkpoint(0.0, "calibrating K on noise");
        const NormalisedFramesPointer firstSegment = segment(0);
        const auto first = beginningOf(*firstSegment, settlingFrames + regulationFrames);
        const auto *chosen = std::get_if<SmdSettings>(&settings.detector);
        const SmdSettings smd = chosen ? *chosen : SmdSettings{};
        const ResetFit fit = fitReset({first}, model, smd);
        result->lnK = fit.lnK;
        result->continuedFraction = fit.continuedFraction;
        trial.frames = firstSegment;
        const Levels levels = levelsOf(*first, *makeDetector(trial));

        const int roughCount = roughCountOf(segmentCount);
        Tail rough;
        inRounds(
            roughCount, context.part(0.1, 0.2), [&](int number) { return measureTail(*segment(number), *makeDetector(trial), levels); },
            [&](const Tail &part) { add(part, rough); });
        fillExceedance(rough.counts, levels, *result);
        const double cells = static_cast<double>(first->grid().size());
        const double columns = std::max(1.0, std::floor(cells / static_cast<double>(blockCells)));
        const RareRates rare = followTail(*firstSegment, model, settings, *result, effort, context.part(0.2, 0.4));
        if (effort.isFirstEstimate && rare.isEmpty())
            return nullptr; // a line through a fifth of the counts tells too little
        const std::vector<double> thresholds =
            thresholdsForEvents(std::move(rough.blockMaxima), static_cast<double>(blockFrames) * cells / columns,
                                rough.cellFrames / roughCount * segmentCount, rare.isEmpty());
        EventCounts counts;
        inRounds(
            segmentCount, context.part(0.4, 1.0),
            [&](int number) {
                Analysis own = trial;
                own.frames = segment(number);
                std::vector<std::unique_ptr<DetectionChain>> chains;
                for (const double threshold : thresholds) {
                    own.threshold = threshold;
                    const bool isLeftOut = !rare.isEmpty() && chains.empty() && (effort.isFirstEstimate || number % crowdedEvery != 0);
                    chains.push_back(isLeftOut ? nullptr : makeChain(own, makeDetector(own), false));
                }
                return countEvents(*own.frames, chains);
            },
            [&](const EventCounts &part) { add(part, counts); });
        if (rare.isEmpty())
            fitEventRate(thresholds, counts.events, counts.cellFrames.front(), *result);
        else
            anchorTail(rare, thresholds, counts, *result);
        return result;
    }

    /// How the chain decides, at whatever threshold.
    DecideSettings withoutThreshold(DecideSettings decide)
    {
        const DecideSettings defaults;
        decide.falseAlarmsPerHour = defaults.falseAlarmsPerHour;
        decide.pfaPerCell = defaults.pfaPerCell;
        decide.thresholdNats = defaults.thresholdNats;
        decide.by = defaults.by;
        return decide;
    }

    /// The settings that the answer to noise depends on.
    AnalysisSettings dimensionless(AnalysisSettings settings)
    {
        settings.selection = {};
        settings.decide = withoutThreshold(settings.decide);
        settings.conventional = {};
        settings.track.bothWays = TrackSettings{}.bothWays; // works on what was found
        settings.spectrogram.windowSeconds = windowSamples;
        return settings;
    }

    /// All that a model's answer to noise depends on, as text.
    std::string nameOf(const MarkovModel &model)
    {
        std::string name = "cells ";
        const auto add = [&](const std::vector<double> &values) {
            for (const double value : values)
                name += formatNumber(value) + ",";
            name += ";";
        };
        for (const KinematicAxis &axis : model.space.axes()) {
            add({static_cast<double>(axis.cells), axis.cyclic ? 1.0 : 0.0, static_cast<double>(axis.firstRate),
                 static_cast<double>(axis.rateCount), static_cast<double>(axis.ratesPerCell),
                 static_cast<double>(axis.rounding), axis.renormalised ? 1.0 : 0.0});
            add(axis.rateChange);
            add(axis.step);
            add(axis.transition);
        }
        add({static_cast<double>(model.likelihood.kind()), model.likelihood.snr(), model.transitionScale});
        return name;
    }

    NormalisedFramesPointer noiseSegment(const AnalysisSettings &bare, int number)
    {
        LineScene scene;
        scene.sampleRateHz = 1.0;
        scene.durationSeconds = static_cast<double>(segmentWindows) * windowSamples;
        scene.isComplex = true;
        scene.noise.deviation = 1.0;
        scene.seed = 1000 + number;
        const auto spectrogram = std::make_shared<Spectrogram>(std::make_shared<SimulatedRecording>(scene), bare.spectrogram);
        return std::make_shared<NormalisedSpectrogram>(spectrogram, estimateBackground(*spectrogram, bare.noise), bare.noise);
    }

    std::string keyOf(const AnalysisSettings &bare, CalibrationDepth depth)
    {
        return settingsToJson(bare) + formatNumber(effortOf(depth).cellFrames);
    }

    /// Null only where `make` answers that.
    std::shared_ptr<const Calibration> kept(const std::string &key, const std::function<std::shared_ptr<const Calibration>()> &make)
    {
        static std::mutex mutex;
        static std::map<std::string, std::shared_ptr<const Calibration>> known;
        {
            const std::scoped_lock lock(mutex);
            if (const auto found = known.find(key); found != known.end())
                return found->second;
        }
        const CalibrationStore store(CalibrationStore::usualFolder());
        auto made = store.load(key);
        if (!made) {
            made = make();
            if (!made)
                return nullptr;
            store.save(key, *made);
        }
        const std::scoped_lock lock(mutex);
        return known.emplace(key, std::move(made)).first->second;
    }

} // namespace

double Calibration::eventRateAt(double nats) const
{
    if (!rates.isEmpty())
        return std::exp(rates.lnRateAt(nats));
    return eventRate * std::exp(-tailSlope * (nats - anchorNats));
}

double Calibration::thresholdForEventRate(double eventsPerCellFrame) const
{
    if (rates.isEmpty())
        return anchorNats + std::log(eventRate / eventsPerCellFrame) / tailSlope;
    double low = rates.levels.front() - 100.0 / tailSlope;
    double high = rates.levels.back() + 1000.0 / tailSlope;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (eventRateAt(middle) > eventsPerCellFrame ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double Calibration::rateUncertaintyAt(double nats) const
{
    const double error =
        rates.isEmpty() ? std::hypot(relativeError, (nats - anchorNats) * slopeError) : rates.relativeErrorAt(nats);
    return std::exp(1.96 * error);
}

double Calibration::thresholdUncertainty(double eventsPerCellFrame) const
{
    const double threshold = thresholdForEventRate(eventsPerCellFrame);
    constexpr double near = 0.5;
    const double slope = std::log(eventRateAt(threshold - near) / eventRateAt(threshold + near)) / (2.0 * near);
    return std::log(rateUncertaintyAt(threshold)) / slope;
}

double Calibration::exceedanceAt(double nats) const
{
    // Simulated where more than a thousand cells speak, continued by the tail's slope beyond.
    std::size_t last = exceedance.size() - 1;
    const double least = 1e-4;
    while (last > 0 && exceedance[last] < least)
        --last;
    if (nats <= levels.front())
        return exceedance.front();
    if (nats >= levels[last])
        return exceedance[last] * eventRateAt(nats)
               / eventRateAt(levels[last]); // time above a level, an event: nearly the same
    const double position = (nats - levels.front()) / (levels[1] - levels[0]);
    const auto lower = static_cast<std::size_t>(position);
    const double fraction = position - static_cast<double>(lower);
    return std::exp((1.0 - fraction) * std::log(exceedance[lower]) + fraction * std::log(exceedance[lower + 1]));
}

double Calibration::thresholdForPfa(double probability) const
{
    double low = levels.front();
    double high = levels.back() + 1000.0 / tailSlope;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (exceedanceAt(middle) > probability ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double Calibration::levelExceededBy(double probability) const
{
    if (levels.empty())
        return -std::numeric_limits<double>::infinity();
    const auto first = std::find_if(exceedance.begin(), exceedance.end(), [&](double p) { return p <= probability; });
    return levels[std::min(static_cast<std::size_t>(first - exceedance.begin()), levels.size() - 1)];
}

std::shared_ptr<const Calibration> calibrate(const AnalysisSettings &settings, const RunContext &context, CalibrationDepth depth)
{
    const AnalysisSettings bare = dimensionless(settings);
    if (depth == CalibrationDepth::FirstEstimate && !isScoreOfPaths(settings.detector))
        return calibrate(settings, context);
    const Effort effort = effortOf(depth);
    const auto result = kept(keyOf(bare, depth), [&] {
        const double perSegment = static_cast<double>(segmentWindows) * bare.spectrogram.stepsPerWindow
            * static_cast<double>(Fft::fastLength(windowSamples * bare.spectrogram.binsPerCell));
        const int segments = std::max(4, static_cast<int>(std::ceil(effort.cellFrames / perSegment)));
        const NoiseSegment segment = remembered([&](int number) { return noiseSegment(bare, number); }, segments);
        return calibrateOn(segment, segments, makeModel(bare.model, segment(0)->grid()), bare, effort, context);
    });
    return result ? result : calibrate(settings, context);
}

std::shared_ptr<const Calibration> calibrateBand(const AnalysisSettings &settings, Index bins, const RunContext &context, CalibrationDepth depth)
{
    constexpr Index wideEnough = 256;   // less than a twentieth of the false alarms is lost at the ends
    constexpr Index endsDoNotMeet = 64; // from here on the ends take away as much, whatever lies between them
    const bool isMoving = settings.model.motion == Motion::Slopes
                          && (settings.model.lowestSlope != 0.0 || settings.model.highestSlope != 0.0);
    if (bins >= wideEnough || !isMoving)
        return calibrate(settings, context, depth);
    const auto wide = calibrate(settings, context.part(0.0, 0.6), depth);
    if (wide->rates.isEmpty())
        return wide;
    const AnalysisSettings bare = dimensionless(settings);
    const Index simulated = std::min(bins, endsDoNotMeet);
    const SplittingSettings splitting = effortOf(depth).splitting;
    const auto narrow = kept("band of " + std::to_string(simulated) + " " + keyOf(bare, depth), [&]() -> std::shared_ptr<const Calibration> {
        const RareRates closed = followBand(bare, wide->lnK, 0, true, splitting, context.part(0.6, 0.8));
        const RareRates band = closed.isEmpty() ? closed : followBand(bare, wide->lnK, simulated, false, splitting, context.part(0.8, 1.0));
        return band.isEmpty() ? wide : narrowed(*wide, band, closed);
    });
    return bins == simulated ? narrow
                             : withShareOfEnds(*wide, *narrow, static_cast<double>(simulated) / static_cast<double>(bins));
}

std::shared_ptr<const Calibration> knownCalibration(const AnalysisSettings &settings)
{
    return kept(keyOf(dimensionless(settings), CalibrationDepth::Refined), [] { return nullptr; });
}

MarkovModel handyPiece(const MarkovModel &model)
{
    constexpr Index many = 20000;
    constexpr Index handy = 5000;
    if (model.space.cellCount() <= many)
        return model;
    std::vector<KinematicAxis> axes = model.space.axes();
    KinematicAxis *longest = nullptr;
    for (KinematicAxis &axis : axes)
        if (!axis.cyclic && (!longest || axis.cells > longest->cells))
            longest = &axis;
    if (!longest)
        return model;
    const Index others = model.space.cellCount() / longest->cells;
    longest->cells = std::clamp<Index>(handy / others, 4 * longest->largestDisplacement() + 1, longest->cells);
    longest->cyclic = true;
    return {StateSpace(std::move(axes)), model.likelihood, model.transitionScale};
}

std::shared_ptr<const Calibration> calibrateOnIndependentCells(const MarkovModel &whole, const AnalysisSettings &settings,
                                                               const RunContext &context, double cellFrames)
{
    const MarkovModel model = handyPiece(whole);
    Grid grid;
    for (const KinematicAxis &axis : model.space.axes())
        grid.axes.push_back({axis.name, "", 0.0, 1.0, axis.cells, axis.cyclic});
    // Sonar's hundred rates a cell cost more than they teach: their paths overlap.
    constexpr double mostStates = 1.2e8; ///< a segment
    const double longest = std::min(4e6 / static_cast<double>(grid.size()), mostStates / static_cast<double>(model.space.stateCount()));
    const auto frames = static_cast<Index>(std::clamp(longest, 600.0, 4000.0));
    const auto segment = [&](int number) -> NormalisedFramesPointer {
        Random random(1000, static_cast<std::uint64_t>(number));
        std::vector<float> values(static_cast<std::size_t>(frames * grid.size()));
        for (float &value : values)
            value = static_cast<float>(random.exponential());
        return std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 1.0, frames, false}, grid, std::move(values));
    };
    const double wanted = std::min(cellFrames, 2.0 * mostStates / static_cast<double>(model.space.planeCount()));
    const int segments = std::max(4, static_cast<int>(std::ceil(wanted / static_cast<double>(frames * grid.size()))));
    AnalysisSettings bare = settings;
    bare.selection = {};
    bare.spectrogram = {};
    bare.noise = {};
    bare.conventional = {};
    bare.decide = withoutThreshold(bare.decide);
    bare.track.bothWays = TrackSettings{}.bothWays;
    return kept(nameOf(model) + settingsToJson(bare) + formatNumber(cellFrames),
                [&] { return calibrateOn(segment, segments, model, settings, {cellFrames}, context); });
}

double thresholdNats(const DecideSettings &decide, const Calibration &calibration, double cellFramesPerHour)
{
    switch (decide.by) {
    case DecideSettings::By::FalseAlarmsPerHour:
        return calibration.thresholdForEventRate(decide.falseAlarmsPerHour / cellFramesPerHour);
    case DecideSettings::By::PfaPerCell:
        return calibration.thresholdForPfa(decide.pfaPerCell);
    case DecideSettings::By::Nats:
        break;
    }
    return decide.thresholdNats;
}

ResetFit fitReset(const std::vector<NormalisedFramesPointer> &noise, const MarkovModel &model, const SmdSettings &smd)
{
    const bool isFound = smd.reset == SmdSettings::Reset::Calibrated || smd.reset == SmdSettings::Reset::Half;
    const double lnK = isFound ? lnKForHalf(noise, model) : smd.lnK;
    const ResetFit measured = measureReset(noise, model, resetRule(smd, lnK));
    return {smd.reset == SmdSettings::Reset::Mean ? measured.lnK : lnK, measured.continuedFraction};
}

ResetRule resetRule(const SmdSettings &settings, double lnK)
{
    switch (settings.reset) {
    case SmdSettings::Reset::Calibrated:
    case SmdSettings::Reset::Fixed:
        return {ResetLaw::Fixed, lnK};
    case SmdSettings::Reset::Half:
        return {ResetLaw::Half, lnK};
    case SmdSettings::Reset::Mean:
        return {ResetLaw::Mean};
    }
    return {};
}

FrameGeometry frameGeometry(const SpectrogramSettings &settings)
{
    return {static_cast<double>(settings.stepsPerWindow), static_cast<double>(settings.binsPerCell)};
}

} // namespace faintline
