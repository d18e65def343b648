#include "refine/levelBeside.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace faintline {

namespace {

    constexpr double nearestCells = 2.5; ///< beyond the main lobe of any window
    constexpr double besideCells = 7.0;
    constexpr Index besideReachFrames[] = {6, 24, 72}; ///< frames, on either side
    constexpr Index valuesPerReach = 6;  ///< values per reach: the level is evaluated at this fraction of it
    constexpr double besideShare = 0.35; ///< of the values, below the quantile: lines may occupy the rest
    constexpr double chanceDeviations = 1.5;
    constexpr double framesPerWindow = 2.0; ///< more frames add hardly any information
    constexpr std::size_t sideMinimumValues = 8;
    constexpr double sideFromCells = 1.5; ///< cells; there the main lobe is 15 dB down
    constexpr double sideToCells = 3.5;

    /// Bins beside a path, nearest to farthest or the other way round.
    struct Side {
        Index from;
        Index to;
    };

    double quantileOfNoise()
    {
        return -std::log1p(-besideShare);
    }

    /// Relative scatter of the quantile of `count` independent values.
    double scatterOf(double count)
    {
        return std::sqrt(besideShare / (1.0 - besideShare) / count) / quantileOfNoise();
    }

    /// Level of one side, or of both.
    struct Level {
        double mean;        ///< the quantile over that of noise of mean 1
        double independent; ///< number of independent values; 0: too few

        /// Level minus what chance may contribute.
        double least() const
        {
            return independent > 0.0 ? mean * (1.0 - chanceDeviations * scatterOf(independent)) : 1.0;
        }
    };

    /// The level on either side of a path.
    class Surroundings
    {
    public:
        Surroundings(const PathStrip &strip, double binsPerCell)
            : m_strip(strip), m_binsPerCell(binsPerCell), m_near(Index(std::ceil(nearestCells * binsPerCell))),
              m_far(levelBesideHalfWidth(binsPerCell))
        {
        }

        /// The lowest level within `reach` frames that chance cannot explain.
        double leastLevel(Index at, Index reach)
        {
            const Level below = levelOf({-m_far, -m_near}, at, reach);
            const Level above = levelOf({m_near, m_far}, at, reach);
            const Level both{0.5 * (below.mean + above.mean), below.independent + above.independent};
            return std::max({below.least(), above.least(), both.least()});
        }

    private:
        Level levelOf(Side side, Index at, Index reach)
        {
            m_values.clear();
            const Index end = std::min(m_strip.frameCount() - 1, at + reach);
            for (Index frame = std::max<Index>(0, at - reach); frame <= end; ++frame)
                for (Index bin = side.from; bin <= side.to; ++bin)
                    if (const float y = m_strip.valueAt(frame, m_strip.centres[std::size_t(frame)] + bin);
                        !std::isnan(y))
                        m_values.push_back(y);
            if (m_values.size() < sideMinimumValues)
                return {1.0, 0.0};
            const auto count = double(m_values.size());
            const auto quantile = m_values.begin() + std::ptrdiff_t(besideShare * count);
            std::nth_element(m_values.begin(), quantile, m_values.end());
            return {double(*quantile) / quantileOfNoise(), count / (framesPerWindow * m_binsPerCell)};
        }

        const PathStrip &m_strip;
        double m_binsPerCell;
        Index m_near;
        Index m_far;
        std::vector<float> m_values;
    };

    /// Appends the observed values above 0 at bins `from` to `to` from the path.
    void appendValues(const PathStrip &strip, Index from, Index to, std::vector<double> &values)
    {
        for (Index at = 0; at < strip.frameCount(); ++at)
            for (Index bin = from; bin <= to; ++bin)
                if (const float y = strip.valueAt(at, strip.centres[std::size_t(at)] + bin); y > 0.0f)
                    values.push_back(double(y));
    }

    std::vector<double> valuesAlong(const PathStrip &strip)
    {
        std::vector<double> values;
        appendValues(strip, 0, 0, values);
        return values;
    }

    /// Below and above.
    std::array<std::vector<double>, 2> valuesOfSides(const PathStrip &strip, double binsPerCell)
    {
        const auto nearest = Index(std::ceil(sideFromCells * binsPerCell));
        const Index farthest = levelOfSidesHalfWidth(binsPerCell);
        std::array<std::vector<double>, 2> values;
        appendValues(strip, -farthest, -nearest, values[0]);
        appendValues(strip, nearest, farthest, values[1]);
        return values;
    }

    double meanOf(const std::vector<double> &values)
    {
        return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
    }

} // namespace

Index levelBesideHalfWidth(double binsPerCell)
{
    return Index(std::ceil(besideCells * binsPerCell));
}

std::vector<double> levelBeside(const PathStrip &strip, double binsPerCell)
{
    std::vector<double> levels(std::size_t(strip.frameCount()), 1.0);
    Surroundings surroundings(strip, binsPerCell);
    for (const Index reach : besideReachFrames) {
        const Index step = std::max<Index>(1, reach / valuesPerReach);
        for (Index from = 0; from < strip.frameCount(); from += step) {
            const Index end = std::min(strip.frameCount(), from + step);
            const double least = surroundings.leastLevel((from + end) / 2, reach);
            for (Index frame = from; frame < end; ++frame) {
                double &level = levels[std::size_t(frame)];
                level = std::max(level, least);
            }
        }
    }
    return levels;
}

Index levelOfSidesHalfWidth(double binsPerCell)
{
    return Index(std::ceil(sideToCells * binsPerCell));
}

double levelOfSides(const PathStrip &strip, double binsPerCell)
{
    double level = 1.0;
    for (const std::vector<double> &side : valuesOfSides(strip, binsPerCell))
        if (side.size() >= sideMinimumValues) {
            double sum = 0.0;
            for (const double y : side)
                sum += std::log(y);
            level = std::max(level, std::exp(sum / double(side.size()) + std::numbers::egamma));
        }
    return level;
}

double shareOfSides(const PathStrip &line, const PathStrip &sides, double binsPerCell)
{
    const std::vector<double> path = valuesAlong(line);
    const auto [below, above] = valuesOfSides(sides, binsPerCell);
    if (std::min({path.size(), below.size(), above.size()}) < sideMinimumValues || meanOf(path) <= 1.0)
        return 0.0;
    return std::max(0.0, (std::min(meanOf(below), meanOf(above)) - 1.0) / (meanOf(path) - 1.0));
}

} // namespace faintline
