#include "refine/bothWays.h"

#include "noise/medians.h"
#include "refine/constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace faintline {

namespace {

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
            m_expected = expectedLevels(seen);
            m_fades = fades(seen);
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

        double lnChange() const { return -std::max(0.5 * m_model.threshold, leastChangeNats); }

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
            runningMean(values, weights, levelHalfFrames, result);
            for (double &level : result)
                level = std::max(0.0, level - 1.0);
            return result;
        }

        /// The likelihood at a level, in half octaves.
        const Likelihood &likelihoodAt(LikelihoodKind kind, double level)
        {
            const auto step =
                int(std::lround(2.0 * std::log2(std::clamp(level, leastLevelRatio, anyLevelRatio) / leastLevelRatio)));
            return m_likelihoods
                .try_emplace(std::pair(kind, step), kind, leastLevelRatio * std::pow(2.0, 0.5 * double(step)))
                .first->second;
        }

        /// Whether the powers of the frames in which the signal is present are those of one whose amplitude varies from
        /// frame to frame, rather than those of the detector's law. Frames near an end of it may not belong to it, so
        /// that they count only if there are no others.
        bool fades(const BothWays &seen)
        {
            if (m_model.likelihood.kind() == LikelihoodKind::Given)
                return false;
            double inside = 0.0;
            double all = 0.0;
            bool hasInside = false;
            for (Index at = 0; at < m_strip.frameCount(); ++at) {
                if (!isPresentAt(seen, at))
                    continue;
                const auto i = std::size_t(at);
                const auto y = double(m_strip.valueAt(at, nearest(seen.positions[i])));
                const double difference = likelihoodAt(LikelihoodKind::Exponential, m_expected[i]).at(y)
                                          - likelihoodAt(m_model.likelihood.kind(), m_expected[i]).at(y);
                all += difference;
                if (isPresentAt(seen, at - levelHalfFrames) && isPresentAt(seen, at + levelHalfFrames)) {
                    inside += difference;
                    hasInside = true;
                }
            }
            return (hasInside ? inside : all) > 0.0;
        }

        bool isPresentAt(const BothWays &seen, Index at) const
        {
            return at >= 0 && at < m_strip.frameCount() && seen.presence.present[std::size_t(at)] > 0.5f;
        }

        double floorAt(Index at) const { return m_strip.floor.empty() ? 1.0 : double(m_strip.floor[std::size_t(at)]); }

        /// The largest mean over ±12 frames about each frame, 12 frames before and 12 frames after it. About the frame
        /// alone, a signal that ends would be expected ever fainter, and its end never be certain. The means are of
        /// power over the noise, each frame as certain as its floor allows; the result is over the floor.
        std::vector<double> expectedLevels(const BothWays &seen) const
        {
            std::vector<double> values;
            std::vector<double> weights;
            for (Index at = 0; at < m_strip.frameCount(); ++at) {
                const float y = m_strip.valueAt(at, nearest(seen.positions[std::size_t(at)]));
                weights.push_back(std::isnan(y) ? 0.0 : 1.0 / (floorAt(at) * floorAt(at)));
                values.push_back(std::isnan(y) ? 0.0 : (double(y) - 1.0) * floorAt(at));
            }
            std::vector<double> means(values.size());
            runningMean(values, weights, levelHalfFrames, means, 1e-9);
            std::vector<double> result;
            const Index last = std::ssize(means) - 1;
            for (Index at = 0; at <= last; ++at)
                result.push_back(
                    std::max({means[std::size_t(at)], means[std::size_t(std::max<Index>(0, at - levelHalfFrames))],
                              means[std::size_t(std::min(last, at + levelHalfFrames))]})
                    / floorAt(at));
            return result;
        }

        const Likelihood &likelihoodFor(const BothWays &seen, Index at, Level level)
        {
            if (level == Level::OfDesign)
                return m_model.likelihood;
            if (level == Level::Own)
                return likelihoodAt(m_model.likelihood.kind(), std::min(seen.levels[std::size_t(at)], keyedLevelRatio));
            return likelihoodAt(m_fades ? LikelihoodKind::Exponential : m_model.likelihood.kind(),
                                m_expected[std::size_t(at)]);
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
            constexpr int parabolaReachBins = 2; ///< maximum distance, in bins, of a parabola from the mean
            std::vector<double> result;
            for (Index at = 0; at < m_strip.frameCount(); ++at) {
                const double level = seen.levels[std::size_t(at)];
                const auto half =
                    Index(std::clamp(singleFrameLevelRatio / std::max(level, 0.1), 1.0, positionHalfFrames));
                std::array<double, 2 * parabolaReachBins + 1> power{};
                for (Index other = std::max<Index>(0, at - half);
                     other <= std::min(m_strip.frameCount() - 1, at + half); ++other)
                    for (std::size_t i = 0; i < power.size(); ++i)
                        if (const double y = powerBeside(seen, other, double(i) - parabolaReachBins); !std::isnan(y))
                            power[i] += y;
                auto peak = std::size_t(std::max_element(power.begin() + 1, power.end() - 1) - power.begin());
                if (power[peak] == power[parabolaReachBins]) // also where nothing was observed
                    peak = parabolaReachBins;
                const auto ln = [&](std::size_t i) { return std::log(std::max(power[i], 1e-9)); };
                const double curvature = ln(peak - 1) - 2.0 * ln(peak) + ln(peak + 1);
                const double within =
                    curvature < 0.0 ? std::clamp(0.5 * (ln(peak - 1) - ln(peak + 1)) / curvature, -0.5, 0.5) : 0.0;
                result.push_back(seen.presence.mean[std::size_t(at)]
                                 + std::clamp(double(peak) - parabolaReachBins + within, -1.0, 1.0));
            }
            return result;
        }

        const PathStrip &m_strip;
        const BothWaysModel &m_model;
        std::map<std::pair<LikelihoodKind, int>, Likelihood> m_likelihoods; ///< by level, in half octaves
        std::vector<double> m_expected;
        bool m_fades = false;
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
