#include "calibrate/measureRareRates.h"

#include "base/Random.h"
#include "base/parallel.h"
#include "calibrate/NoiseWalker.h"
#include "calibrate/noiseCounts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace faintline {

namespace {

    constexpr int streams = 16;          ///< streams in which the first level is searched for
    constexpr int quantileFrames = 2000; ///< of each stream, for the base and the first level
    constexpr double baseQuantile = 0.8;
    constexpr double firstQuantile = 0.96;
    constexpr double pilotFraction = 0.2;    ///< fraction that reaches the next level
    constexpr int trialLimitFrames = 3000;   ///< frames; if K is so large that paths do not end, there are no rare
                                             ///< excursions
    constexpr int searchLimitFrames = 20000; ///< frames per stream until the first level is entered
    constexpr int endlessLimitPilots = 4;    ///< of the pilot trials
    constexpr int mostLevels = 60;
    constexpr int levelMinimumSuccesses = 10;
    constexpr int replicates = 4; ///< independent runs, whose scatter includes the effect of shared ancestors
    constexpr double acceptedRelativeError = 0.5; ///< relative, of an accepted rate
    constexpr double acceptedDepthShare = 0.7;    ///< fraction of leastLnRate that must be reached with this error

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
            for (int number = 1; number < mostLevels && lnRate > m_settings.leastLnRate; ++number) {
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
                if (std::ssize(entered) < levelMinimumSuccesses)
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
            std::vector<std::vector<double>> maxima(streams);
            parallelFor(streams, m_context, "noise", [&] {
                return [&](Index stream) {
                    const auto walker = m_makeWalker(); // a detector at its first frame
                    Random random = randomOf(0, stream);
                    for (int frame = 0; frame < settlingFrames + quantileFrames / streams; ++frame)
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
            const int wanted = (m_settings.entries + streams - 1) / streams;
            std::vector<std::vector<NoiseParticle>> entered(streams);
            std::vector<double> frames(streams);
            parallelFor(streams, m_context, "noise", [&] {
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
    for (int run = 0; run < replicates; ++run) {
        SplittingSettings own = settings;
        own.entries = std::max(1, settings.entries / replicates);
        own.seed = settings.seed + std::uint64_t(run) * 10000;
        runs.push_back(Splitting(makeDetector, makeNoise, own,
                                 context.part(double(run) / replicates, double(run + 1) / replicates))
                           .run());
        if (runs.back().isEmpty())
            return {};
    }
    RareRates result = combined(runs);
    if (result.isEmpty() || result.lnRates.back() > acceptedDepthShare * settings.leastLnRate)
        return {};
    return result;
}

} // namespace faintline
