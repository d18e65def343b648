#include "calibrate/measureRareRates.h"

#include "base/Random.h"
#include "base/parallel.h"
#include "calibrate/constants.h"
#include "calibrate/noiseCounts.h"
#include "detect/Detector.h"
#include "noise/noiseStreams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace faintline {

/// State of noise and detector at one moment.
struct NoiseParticle {
    std::vector<float> noise;
    std::shared_ptr<const DetectorState> detector;
    double reached = 0.0; ///< largest D of the frame
};

/// Noise and a detector on it, frame by frame; it can continue from the state of another.
class NoiseWalker
{
public:
    NoiseWalker(std::unique_ptr<Detector> detector, std::unique_ptr<NoiseStream> noise)
        : m_detector(std::move(detector)), m_noise(std::move(noise)), m_y(std::size_t(m_noise->cells())),
          m_statistic(m_y.size())
    {
    }

    /// Takes the next frame; returns its largest D.
    double step(Random &random)
    {
        m_noise->next(random, m_y);
        m_detector->update(m_y, m_statistic);
        return double(*std::max_element(m_statistic.begin(), m_statistic.end()));
    }

    NoiseParticle particle(double reached) const { return {m_noise->state(), m_detector->state(), reached}; }
    void take(const NoiseParticle &particle)
    {
        m_noise->setState(particle.noise);
        m_detector->setState(*particle.detector);
    }
    Index cells() const { return m_noise->cells(); }

private:
    std::unique_ptr<Detector> m_detector;
    std::unique_ptr<NoiseStream> m_noise;
    std::vector<float> m_y;
    std::vector<float> m_statistic;
};

namespace {

    double quantileOf(std::vector<double> values, double p)
    {
        const auto at = values.begin() + std::ptrdiff_t(p * double(values.size() - 1));
        std::nth_element(values.begin(), at, values.end());
        return *at;
    }

    class Splitting
    {
    public:
        Splitting(const std::function<std::unique_ptr<Detector>()> &makeDetector,
                  const std::function<std::unique_ptr<NoiseStream>()> &makeNoise, const SplittingSettings &settings,
                  const RunContext &context)
            : m_makeWalker([&] { return std::make_shared<NoiseWalker>(makeDetector(), makeNoise()); }),
              m_settings(settings), m_context(context)
        {
        }

        RareRates run()
        {
            findFirstLevel();
            double lnRate = enterFirstLevel();
            double variance = 1.0 / double(m_entered.size());
            append(m_level, lnRate, variance);
            for (int number = 1; number < splittingLevelLimit && lnRate > m_settings.leastLnRate; ++number) {
                m_context.checkpoint(std::min(1.0, lnRate / m_settings.leastLnRate),
                                     "simulating rare excursions of the noise");
                const double next = nextLevel(number);
                if (std::isinf(next))
                    return {};
                if (!(next > m_level))
                    break;
                const std::vector<std::optional<NoiseParticle>> outcomes = trials(number, next);
                std::vector<NoiseParticle> entered;
                for (const std::optional<NoiseParticle> &outcome : outcomes)
                    if (outcome)
                        entered.push_back(*outcome);
                if (std::ssize(entered) < fewestLevelSuccesses)
                    break;
                const double p = double(entered.size()) / double(outcomes.size());
                lnRate += std::log(p);
                variance += (1.0 - p) / double(entered.size());
                m_level = next;
                m_entered = std::move(entered);
                append(m_level, lnRate, variance);
            }
            return m_result;
        }

    private:
        void append(double level, double lnRate, double variance)
        {
            m_result.levels.push_back(level);
            m_result.lnRates.push_back(lnRate);
            m_result.relativeErrors.push_back(std::sqrt(variance));
        }

        Random randomOf(int level, Index trial) const
        {
            return {m_settings.seed + std::uint64_t(level), std::uint64_t(trial)};
        }

        void findFirstLevel()
        {
            std::vector<std::vector<double>> maxima(quantileStreams);
            parallelFor(quantileStreams, m_context, "noise", [&] {
                return [&](Index stream) {
                    const auto walker = m_makeWalker(); // a detector at its first frame
                    Random random = randomOf(0, stream);
                    for (int frame = 0; frame < settlingFrames + quantileFrames / quantileStreams; ++frame)
                        if (const double reached = walker->step(random);
                            frame >= settlingFrames && std::isfinite(reached))
                            maxima[std::size_t(stream)].push_back(reached);
                };
            });
            std::vector<double> all;
            for (const std::vector<double> &some : maxima)
                all.insert(all.end(), some.begin(), some.end());
            if (all.empty())
                return;
            m_base = quantileOf(all, baseQuantile);
            m_level = quantileOf(all, firstQuantile);
        }

        /// Computes ln of the rate of cycles and stores the particles that enter the first level.
        double enterFirstLevel()
        {
            const int wanted = (m_settings.entries + quantileStreams - 1) / quantileStreams;
            std::vector<std::vector<NoiseParticle>> entered(quantileStreams);
            std::vector<double> frames(quantileStreams);
            parallelFor(quantileStreams, m_context, "noise", [&] {
                return [&](Index stream) {
                    const auto walker = m_makeWalker();
                    Random random = randomOf(1000, stream);
                    for (int frame = 0; frame < settlingFrames; ++frame)
                        walker->step(random);
                    auto &own = entered[std::size_t(stream)];
                    bool isBelow = false;
                    for (double &count = frames[std::size_t(stream)];
                         std::ssize(own) < wanted && count < searchLimitFrames; ++count) {
                        const double reached = walker->step(random);
                        if (isBelow && reached > m_level) {
                            own.push_back(walker->particle(reached));
                            isBelow = false;
                        } else if (reached < m_base) {
                            isBelow = true;
                        }
                    }
                };
            });
            double total = 0.0;
            for (std::size_t stream = 0; stream < entered.size(); ++stream) {
                total += frames[stream];
                m_entered.insert(m_entered.end(), entered[stream].begin(), entered[stream].end());
            }
            const auto cells = double(m_makeWalker()->cells());
            return m_entered.empty() ? -std::numeric_limits<double>::infinity()
                                     : std::log(double(m_entered.size()) / (total * cells));
        }

        /// Runs from one of the entered states, with new noise, to the next level or back to the base; returns the
        /// highest D, or ∞ if it does not end.
        double walk(NoiseWalker &walker, Random &random, double next, std::optional<NoiseParticle> *outcome) const
        {
            const auto number =
                std::min(std::size_t(random.uniform() * double(m_entered.size())), m_entered.size() - 1);
            const NoiseParticle &start = m_entered[number];
            double highest = start.reached;
            if (highest > next) {
                *outcome = start;
                return highest;
            }
            walker.take(start);
            for (int frame = 0; frame < trialLimitFrames; ++frame) {
                const double reached = walker.step(random);
                highest = std::max(highest, reached);
                if (reached > next) {
                    *outcome = walker.particle(reached);
                    return highest;
                }
                if (reached < m_base)
                    return highest;
            }
            return std::numeric_limits<double>::infinity();
        }

        double nextLevel(int number) const
        {
            std::vector<double> highest(std::size_t(m_settings.pilots));
            parallelFor(m_settings.pilots, m_context, "noise", [&] {
                return [&, walker = m_makeWalker()](Index trial) {
                    Random random = randomOf(2000 + number, trial);
                    std::optional<NoiseParticle> ignored;
                    highest[std::size_t(trial)] =
                        walk(*walker, random, std::numeric_limits<double>::infinity(), &ignored);
                };
            });
            if (std::count(highest.begin(), highest.end(), std::numeric_limits<double>::infinity())
                > endlessLimitPilots)
                return std::numeric_limits<double>::infinity();
            return quantileOf(highest, 1.0 - pilotFraction);
        }

        std::vector<std::optional<NoiseParticle>> trials(int number, double next) const
        {
            std::vector<std::optional<NoiseParticle>> outcomes(std::size_t(m_settings.entries));
            parallelFor(std::ssize(outcomes), m_context, "noise", [&] {
                return [&, walker = m_makeWalker()](Index trial) {
                    Random random = randomOf(3000 + number, trial);
                    walk(*walker, random, next, &outcomes[std::size_t(trial)]);
                };
            });
            return outcomes;
        }

        std::function<std::shared_ptr<NoiseWalker>()> m_makeWalker;
        const SplittingSettings &m_settings;
        const RunContext &m_context;
        double m_base = 0.0;
        double m_level = 0.0;
        std::vector<NoiseParticle> m_entered;
        RareRates m_result;
    };

    /// The mean rate of independent runs, at those levels of the first that all of them reach.
    RareRates combined(const std::vector<RareRates> &runs)
    {
        RareRates result;
        const auto count = double(runs.size());
        for (std::size_t i = 0; i < runs.front().levels.size(); ++i) {
            const double level = runs.front().levels[i];
            const bool isReached = std::all_of(runs.begin(), runs.end(),
                                               [&](const RareRates &run) { return level <= run.levels.back() + 2.0; });
            if (!isReached)
                break;
            double mean = 0.0, square = 0.0, variance = 0.0;
            for (const RareRates &run : runs) {
                const double relative = std::exp(run.lnRateAt(level) - runs.front().lnRates[i]);
                mean += relative / count;
                square += relative * relative / count;
                variance += run.relativeErrorAt(level) * run.relativeErrorAt(level) / (count * count);
            }
            const double scatter = (square / (mean * mean) - 1.0) / (count - 1.0);
            if (std::max(variance, scatter) > acceptedRelativeError * acceptedRelativeError)
                break;
            result.levels.push_back(level);
            result.lnRates.push_back(runs.front().lnRates[i] + std::log(mean));
            result.relativeErrors.push_back(std::sqrt(std::max(variance, scatter)));
        }
        return result;
    }

    /// V and weight of the blocks of one run at their end.
    struct TiltedBlocks {
        double lnZ = 0.0;
        std::vector<double> values;
        std::vector<double> weights; ///< Σ = 1
    };

    /// Subtracts the logarithm of the mean weight from the logarithms of weights; returns it.
    double normalise(std::vector<double> &lnWeights)
    {
        const double most = *std::max_element(lnWeights.begin(), lnWeights.end());
        double sum = 0.0;
        for (const double ln : lnWeights)
            sum += std::exp(ln - most);
        const double lnMean = most + std::log(sum / double(lnWeights.size()));
        for (double &ln : lnWeights)
            ln -= lnMean;
        return lnMean;
    }

    /// Number of equal weights that would scatter as much.
    double effectiveSize(const std::vector<double> &lnWeights)
    {
        double squares = 0.0;
        for (const double ln : lnWeights)
            squares += std::exp(2.0 * ln);
        return double(lnWeights.size()) * double(lnWeights.size()) / squares;
    }

    /// Blocks of noise side by side, under one tilt.
    class BlockRun
    {
    public:
        BlockRun(const std::function<std::unique_ptr<NoiseWalker>()> &makeWalker, Index blocks, double tilt,
                 Random random)
            : m_tilt(tilt), m_random(random), m_values(std::size_t(blocks), 0.0), m_lnWeights(m_values.size(), 0.0)
        {
            for (Index block = 0; block < blocks; ++block)
                m_walkers.push_back(makeWalker());
        }

        TiltedBlocks run(Index frames)
        {
            for (Index frame = 0; frame < frames; ++frame) {
                step();
                if (m_tilt != 0.0 && effectiveSize(m_lnWeights) < 0.5 * double(m_values.size()))
                    resample();
            }
            for (double &ln : m_lnWeights)
                ln = std::exp(ln) / double(m_values.size());
            return {m_lnZ, std::move(m_values), std::move(m_lnWeights)};
        }

    private:
        void step()
        {
            for (std::size_t i = 0; i < m_values.size(); ++i) {
                const double value = m_walkers[i]->step(m_random);
                m_lnWeights[i] += m_tilt * (value - m_values[i]);
                m_values[i] = value;
            }
            m_lnZ += normalise(m_lnWeights);
        }

        /// Systematic resampling: block i continues ⌊weight⌋ or ⌈weight⌉ times.
        void resample()
        {
            std::vector<Index> copies(m_values.size(), 0);
            double position = m_random.uniform();
            double sum = 0.0;
            for (std::size_t i = 0; i < copies.size(); ++i)
                for (sum += std::exp(m_lnWeights[i]); position < sum && position < double(copies.size()); ++position)
                    ++copies[i];
            std::size_t free = 0;
            for (std::size_t i = 0; i < copies.size(); ++i) {
                if (copies[i] < 2)
                    continue;
                const NoiseParticle state = m_walkers[i]->particle(m_values[i]);
                for (; copies[i] > 1; --copies[i]) {
                    while (free < copies.size() && copies[free] != 0)
                        ++free;
                    if (free == copies.size())
                        break; // rounding
                    m_walkers[free]->take(state);
                    m_values[free] = state.reached;
                    copies[free] = 1;
                }
            }
            std::fill(m_lnWeights.begin(), m_lnWeights.end(), 0.0);
        }

        double m_tilt;
        Random m_random;
        std::vector<std::unique_ptr<NoiseWalker>> m_walkers;
        std::vector<double> m_values;
        std::vector<double> m_lnWeights; ///< of mean weight 1
        double m_lnZ = 0.0;
    };

    struct Moments {
        double mean = 0.0;
        double deviation = 0.0;
    };

    Moments momentsOf(const std::vector<TiltedBlocks> &runs)
    {
        double mean = 0.0;
        double square = 0.0;
        const auto count = double(runs.size());
        for (const TiltedBlocks &run : runs)
            for (std::size_t i = 0; i < run.values.size(); ++i) {
                mean += run.weights[i] * run.values[i] / count;
                square += run.weights[i] * run.values[i] * run.values[i] / count;
            }
        return {mean, std::sqrt(std::max(0.0, square - mean * mean))};
    }

    /// One repetition: its runs, one for each tilt.
    class Tail
    {
    public:
        void add(double tilt, TiltedBlocks run)
        {
            m_tilts.push_back(tilt);
            m_runs.push_back(std::move(run));
        }

        /// P(V > level)
        double exceedance(double level) const
        {
            double sum = 0.0;
            for (const TiltedBlocks &run : m_runs)
                for (std::size_t i = 0; i < run.values.size(); ++i)
                    if (run.values[i] > level)
                        sum += run.weights[i] / density(run.values[i]);
            return sum;
        }

    private:
        /// Sum of the runs' densities over that of noise.
        double density(double value) const
        {
            double sum = 0.0;
            for (std::size_t j = 0; j < m_runs.size(); ++j)
                sum += std::exp(m_tilts[j] * value - m_runs[j].lnZ);
            return sum;
        }

        std::vector<double> m_tilts;
        std::vector<TiltedBlocks> m_runs;
    };

    /// Appends a level's rate; returns whether its error is small enough.
    bool append(const std::vector<Tail> &tails, double level, double cellFrames, RareRates &result)
    {
        double mean = 0.0;
        double square = 0.0;
        const auto count = double(tails.size());
        for (const Tail &tail : tails) {
            const double p = tail.exceedance(level);
            mean += p / count;
            square += p * p / count;
        }
        if (!(mean > 0.0 && mean < 1.0))
            return mean >= 1.0; // such a level is not rare
        const double error = std::sqrt(std::max(0.0, square / (mean * mean) - 1.0) / (count - 1.0));
        if (error > acceptedRelativeError)
            return false;
        result.levels.push_back(level);
        result.lnRates.push_back(std::log(-std::log1p(-mean) / cellFrames));
        // The scatter of six repetitions is small by chance now and then.
        const double least = result.relativeErrors.empty() ? 0.0 : result.relativeErrors.back();
        result.relativeErrors.push_back(std::max(error, least));
        return true;
    }

} // namespace

RareRates measureRareRates(const std::function<std::unique_ptr<Detector>()> &makeDetector,
                           const std::function<std::unique_ptr<NoiseStream>()> &makeNoise,
                           const SplittingSettings &settings, const RunContext &context)
{
    constexpr std::size_t mostBytes = std::size_t(64) << 20; // of all initial states of a level
    const auto state = makeDetector()->state();
    if (!state || state->bytes() * std::size_t(settings.entries) > mostBytes)
        return {};
    std::vector<RareRates> runs;
    for (int run = 0; run < splittingReplicates; ++run) {
        SplittingSettings own = settings;
        own.entries = std::max(1, settings.entries / splittingReplicates);
        own.seed = settings.seed + std::uint64_t(run) * 10000;
        runs.push_back(Splitting(makeDetector, makeNoise, own,
                                 context.part(double(run) / splittingReplicates, double(run + 1) / splittingReplicates))
                           .run());
        if (runs.back().isEmpty())
            return {};
    }
    RareRates result = combined(runs);
    if (result.isEmpty() || result.lnRates.back() > acceptedDepthShare * settings.leastLnRate)
        return {};
    return result;
}

RareRates measureBlockRates(const std::function<std::unique_ptr<Detector>()> &makeDetector,
                            const std::function<std::unique_ptr<NoiseStream>()> &makeNoise, Index framesPerBlock,
                            const SplittingSettings &settings, const RunContext &context)
{
    constexpr std::size_t mostBytes = std::size_t(64) << 20;
    const auto makeWalker = [&] { return std::make_unique<NoiseWalker>(makeDetector(), makeNoise()); };
    const auto state = makeDetector()->state();
    const Index blocks = std::min(tiltBlockLimit, Index(framesOfTilt / double(tiltRepetitions * framesPerBlock)));
    if (!state || state->bytes() * std::size_t(blocks * tiltRepetitions) > mostBytes || blocks < fewestTiltBlocks)
        return {};
    const double cellFrames = double(makeNoise()->cells()) * double(framesPerBlock);

    std::vector<Tail> tails{std::size_t(tiltRepetitions)};
    double tilt = 0.0;
    double from = 0.0;
    double spacing = 1.0;
    double highest = -std::numeric_limits<double>::infinity();
    for (std::size_t number = 0; number < tiltLimit; ++number) {
        context.checkpoint(double(number) / double(tiltLimit), "simulating rare blocks of the noise");
        std::vector<TiltedBlocks> runs{std::size_t(tiltRepetitions)};
        parallelFor(tiltRepetitions, context, "noise", [&] {
            return [&](Index repetition) {
                const Random random(settings.seed + number, std::uint64_t(repetition));
                runs[std::size_t(repetition)] = BlockRun(makeWalker, blocks, tilt, random).run(framesPerBlock);
            };
        });
        const auto [mean, deviation] = momentsOf(runs);
        if (!(deviation > 0.0) || mean < highest)
            break; // noise gets no further
        highest = mean;
        for (std::size_t i = 0; i < runs.size(); ++i)
            tails[i].add(tilt, std::move(runs[i]));
        if (number == 0) {
            from = mean + firstLevelDeviations * deviation;
            spacing = levelSpacingDeviations * deviation;
        }
        double rate = 0.0;
        for (const Tail &tail : tails)
            rate += tail.exceedance(mean) / (cellFrames * double(tiltRepetitions));
        if (rate < std::exp(settings.leastLnRate))
            break;
        tilt += 1.0 / deviation;
    }
    RareRates result;
    for (double level = from; level <= highest && append(tails, level, cellFrames, result);)
        level += spacing;
    if (result.isEmpty() || result.lnRates.back() > acceptedDepthShare * settings.leastLnRate)
        return {};
    return result;
}

} // namespace faintline
