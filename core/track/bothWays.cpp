#include "track/bothWays.h"

#include "spectrum/medians.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace faintline {

namespace {

    constexpr double corridorCells = 3.0; ///< resolution cells on either side of the path
    constexpr Index levelFrames = 12;     ///< on either side
    constexpr double leastChange = 2.0;   ///< nat: minimum cost of an interruption, even with a low threshold
    constexpr double leastLevel = 0.5;
    constexpr double largestLevel = 4.0;
    constexpr double levelOfOneFrame = 10.0; ///< from this SNR on, the neighbouring frames suffice for a frame's
                                             ///< position
    constexpr double framesAtMost = 8.0;

    Index inBins(double cells, double binsPerCell)
    {
        return Index(std::ceil(cells * binsPerCell));
    }

    Index nearest(double position)
    {
        return Index(std::lround(position));
    }

    class Look
    {
    public:
        Look(const PathStrip &strip, const BothWaysModel &model) : m_strip(strip), m_model(model) {}

        BothWays run()
        {
            BothWays seen = alongCentres();
            for (int round = 0; round < 2; ++round) {
                seen.levels = levels(seen);
                seen.presence = presenceIn(corridor(seen, Level::Own), *m_model.axis, lnChange(), m_strip.firstFrame);
                seen.positions = seen.presence.mean;
            }
            seen.levels = levels(seen);
            seen.endsBy =
                presenceIn(corridor(seen, Level::Expected), *m_model.axis, lnChange(), m_strip.firstFrame, m_model.ends)
                    .present;
            seen.gains = gains(seen);
            seen.positions = refined(seen);
            return seen;
        }

        std::vector<double> slopeChanges()
        {
            return expectedSlopeChanges(corridor(run(), Level::Own), *m_model.axis, lnChange(), m_strip.firstFrame);
        }

        double strongest()
        {
            return strongestPath(corridor(alongCentres(), Level::OfDesign), *m_model.axis, m_model.lnK,
                                 m_strip.firstFrame);
        }

    private:
        /// The level for which a frame's evidence is computed.
        enum class Level {
            OfDesign, ///< the detector's
            Own,      ///< mean over ±12 frames
            Expected  ///< if the signal goes on as in the 24 frames before or after
        };

        BothWays alongCentres() const
        {
            BothWays seen;
            for (const Index centre : m_strip.centres)
                seen.positions.push_back(double(centre));
            return seen;
        }

        double lnChange() const { return -std::max(0.5 * m_model.threshold, leastChange); }

        std::vector<double> levels(const BothWays &seen) const
        {
            std::vector<double> values;
            std::vector<double> weights;
            for (Index at = 0; at < m_strip.frameCount(); ++at) {
                const float y = m_strip.valueAt(at, nearest(seen.positions[std::size_t(at)]));
                weights.push_back(std::isnan(y) ? 0.0 : 1.0);
                values.push_back(std::isnan(y) ? 0.0 : double(y));
            }
            std::vector<double> result(values.size());
            runningMean(values, weights, levelFrames, result);
            for (double &level : result)
                level = std::max(0.0, level - 1.0);
            return result;
        }

        /// The likelihood at a track's own level, in half octaves.
        const Likelihood &likelihoodAt(double level)
        {
            const auto step =
                int(std::lround(2.0 * std::log2(std::clamp(level, leastLevel, largestLevel) / leastLevel)));
            const auto found = m_likelihoods.find(step);
            return found != m_likelihoods.end() ? found->second
                                                : m_likelihoods
                                                      .emplace(step, Likelihood(m_model.likelihood.kind(),
                                                                                leastLevel * std::pow(2.0, 0.5 * step)))
                                                      .first->second;
        }

        /// The largest mean over ±12 frames about a frame, 12 frames before and 12 frames after it. About the frame
        /// alone, a signal that ends would be expected ever fainter, and its end never be certain.
        static double expectedLevel(const std::vector<double> &levels, Index at)
        {
            const Index last = std::ssize(levels) - 1;
            return std::max({levels[std::size_t(at)], levels[std::size_t(std::max<Index>(0, at - levelFrames))],
                             levels[std::size_t(std::min(last, at + levelFrames))]});
        }

        const Likelihood &likelihoodFor(const BothWays &seen, Index at, Level level)
        {
            if (level == Level::OfDesign)
                return m_model.likelihood;
            return likelihoodAt(level == Level::Own ? seen.levels[std::size_t(at)] : expectedLevel(seen.levels, at));
        }

        Corridor corridor(const BothWays &seen, Level level)
        {
            const Index half = inBins(corridorCells, m_model.binsPerCell);
            const Index cells = m_model.axis->cells;
            Corridor result;
            result.width = 2 * half + 1;
            result.lambda.resize(std::size_t(m_strip.frameCount() * result.width));
            std::vector<float> y(std::size_t(result.width));
            for (Index at = 0; at < m_strip.frameCount(); ++at) {
                const Index first = nearest(seen.positions[std::size_t(at)]) - half;
                result.firstCells.push_back(first);
                for (Index i = 0; i < result.width; ++i)
                    y[std::size_t(i)] = m_strip.valueAt(at, first + i);
                const std::span<float> lambda =
                    std::span(result.lambda).subspan(std::size_t(at * result.width), y.size());
                likelihoodFor(seen, at, level).apply(y, lambda);
                for (Index i = 0; i < result.width; ++i)
                    if (first + i < 0 || first + i >= cells)
                        lambda[std::size_t(i)] = -std::numeric_limits<float>::infinity();
            }
            return result;
        }

        std::vector<double> gains(const BothWays &seen) const
        {
            const double staying = std::log(m_model.axis->rateChange.front());
            std::vector<double> result;
            for (Index at = 0; at < m_strip.frameCount(); ++at) {
                const float y = m_strip.valueAt(at, nearest(seen.presence.mean[std::size_t(at)]));
                result.push_back(m_model.likelihood.at(double(y)) + m_model.lnK[std::size_t(at)] + staying);
            }
            return result;
        }

        /// Interpolates y between cells, along the mean path.
        double powerBeside(const BothWays &seen, Index at, double offset) const
        {
            const double position = seen.presence.mean[std::size_t(at)] + offset;
            const double below = std::floor(position);
            const double share = position - below;
            const auto cell = Index(below);
            return (1.0 - share) * double(m_strip.valueAt(at, cell)) + share * double(m_strip.valueAt(at, cell + 1));
        }

        std::vector<double> refined(const BothWays &seen) const
        {
            constexpr int farthest = 2; ///< maximum distance, in bins, of a parabola from the mean
            std::vector<double> result;
            for (Index at = 0; at < m_strip.frameCount(); ++at) {
                const double level = seen.levels[std::size_t(at)];
                const auto half = Index(std::clamp(levelOfOneFrame / std::max(level, 0.1), 1.0, framesAtMost));
                std::array<double, 2 * farthest + 1> power{};
                for (Index other = std::max<Index>(0, at - half);
                     other <= std::min(m_strip.frameCount() - 1, at + half); ++other)
                    for (std::size_t i = 0; i < power.size(); ++i)
                        if (const double y = powerBeside(seen, other, double(i) - farthest); !std::isnan(y))
                            power[i] += y;
                const auto peak = std::size_t(std::max_element(power.begin() + 1, power.end() - 1) - power.begin());
                const auto ln = [&](std::size_t i) { return std::log(std::max(power[i], 1e-9)); };
                const double curvature = ln(peak - 1) - 2.0 * ln(peak) + ln(peak + 1);
                const double within =
                    curvature < 0.0 ? std::clamp(0.5 * (ln(peak - 1) - ln(peak + 1)) / curvature, -0.5, 0.5) : 0.0;
                result.push_back(seen.presence.mean[std::size_t(at)]
                                 + std::clamp(double(peak) - farthest + within, -1.0, 1.0));
            }
            return result;
        }

        const PathStrip &m_strip;
        const BothWaysModel &m_model;
        std::map<int, Likelihood> m_likelihoods; ///< by level, in half octaves
    };

} // namespace

Index bothWaysHalfWidth(double binsPerCell)
{
    return 2 * inBins(corridorCells, binsPerCell) + 2;
}

Index corridorHalfWidth(double binsPerCell)
{
    return inBins(corridorCells, binsPerCell);
}

BothWays lookBothWays(const PathStrip &strip, const BothWaysModel &model)
{
    return Look(strip, model).run();
}

std::vector<double> slopeChangesOf(const PathStrip &strip, const BothWaysModel &model)
{
    return Look(strip, model).slopeChanges();
}

double strongestIn(const PathStrip &strip, const BothWaysModel &model)
{
    return Look(strip, model).strongest();
}

} // namespace faintline
