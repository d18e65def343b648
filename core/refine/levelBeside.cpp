#include "refine/levelBeside.h"

#include "noise/levels.h"
#include "refine/constants.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace faintline {

namespace {

    /// Bins beside a path, nearest to farthest or the other way round.
    struct Side {
        Index from;
        Index to;
    };

    double quantileOfNoise()
    {
        return -std::log1p(-besideQuantile);
    }

    /// Relative scatter of the quantile of `count` independent values.
    double scatterOf(double count)
    {
        return std::sqrt(besideQuantile / (1.0 - besideQuantile) / count) / quantileOfNoise();
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
            : m_strip(strip), m_binsPerCell(binsPerCell), m_near(Index(std::ceil(besideFromCells * binsPerCell))),
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
            if (m_values.size() < fewestAreaValues)
                return {1.0, 0.0};
            const auto count = double(m_values.size());
            const auto quantile = m_values.begin() + std::ptrdiff_t(besideQuantile * count);
            std::nth_element(m_values.begin(), quantile, m_values.end());
            return {double(*quantile) / quantileOfNoise(), count / (informativeFramesPerWindow * m_binsPerCell)};
        }

        const PathStrip &m_strip;
        double m_binsPerCell;
        Index m_near;
        Index m_far;
        std::vector<float> m_values;
    };

    /// Mean movement of a path within a window of two frames.
    double movedInWindow(const std::vector<double> &positions)
    {
        double moved = 0.0;
        for (std::size_t i = 2; i < positions.size(); ++i)
            moved += std::abs(positions[i] - positions[i - 2]) / double(positions.size() - 2);
        return moved;
    }

    /// Levels of areas at a distance from a path.
    class AreaSearch
    {
    public:
        AreaSearch(const PathStrip &strip, const std::vector<double> &positions, double cellsAsOne)
            : m_strip(strip), m_positions(positions), m_cellsAsOne(cellsAsOne)
        {
        }

        /// Raises `levels` to those on the given sides, at a distance of `from` to `to` bins.
        void raise(std::vector<double> &levels, Index from, Index to, bool isBelow, bool isAbove)
        {
            m_from = from;
            m_to = to;
            m_isBelow = isBelow;
            m_isAbove = isAbove;
            m_levels.assign(levels.size(), 1.0);
            search(0, std::ssize(levels));
            for (std::size_t i = 0; i < levels.size(); ++i)
                levels[i] = std::max(levels[i], m_levels[i]);
        }

    private:
        /// Gain of the best partition of frames `first` up to, not including, `end`, whose levels it sets.
        double search(Index first, Index end)
        {
            double level = 1.0;
            double gain = gainOf(first, end, level);
            if (end - first >= 2) {
                const Index middle = (first + end) / 2;
                if (const double parts = search(first, middle) + search(middle, end); parts > gain)
                    return parts;
            }
            std::fill(m_levels.begin() + first, m_levels.begin() + end, level);
            return gain;
        }

        /// Nats for the choice of the sides, of four, and of the place among those of equal length.
        double price(Index first, Index end) const
        {
            return std::log(4.0 * double(m_strip.frameCount()) / double(end - first));
        }

        double gainOf(Index first, Index end, double &level)
        {
            m_values.clear();
            const Index step = std::max<Index>(1, (end - first) / areaSampledFrames);
            for (Index at = first; at < end; at += step) {
                const auto centre = Index(std::lround(m_positions[std::size_t(at)]));
                for (Index d = m_from; d <= m_to; ++d) {
                    if (const float y = m_strip.valueAt(at, centre - d); m_isBelow && !std::isnan(y))
                        m_values.push_back(y);
                    if (const float y = m_strip.valueAt(at, centre + d); m_isAbove && !std::isnan(y))
                        m_values.push_back(y);
                }
            }
            if (m_values.size() < fewestAreaValues)
                return 0.0;
            const std::size_t lower = m_values.size() / 2;
            const auto median = m_values.begin() + std::ptrdiff_t(lower - 1);
            std::nth_element(m_values.begin(), median, m_values.end());
            const double sum = std::accumulate(m_values.begin(), median + 1, 0.0);
            const double mean = (sum + double(m_values.size() - lower) * double(*median)) / double(lower);
            const double independent = double(lower) / m_cellsAsOne;
            if (mean <= 1.0)
                return 0.0;
            const double gain = independent * (mean - 1.0 - std::log(mean)) - 0.5 * std::log(std::max(1.0, independent))
                                - price(first, end);
            if (gain <= 0.0)
                return 0.0;
            level = mean;
            return gain;
        }

        const PathStrip &m_strip;
        const std::vector<double> &m_positions;
        double m_cellsAsOne;
        Index m_from = 0; ///< bins
        Index m_to = 0;
        bool m_isBelow = false;
        bool m_isAbove = false;
        std::vector<double> m_levels;
        std::vector<float> m_values;
    };

} // namespace

Index levelBesideHalfWidth(double binsPerCell)
{
    return Index(std::ceil(besideToCells * binsPerCell));
}

PathStrip withoutLine(PathStrip strip, const std::vector<double> &positions, const std::vector<double> &levels,
                      WindowShape window, double binsPerCell)
{
    for (Index at = 0; at < strip.frameCount(); ++at)
        for (Index k = 0; k < strip.width(); ++k) {
            const double apart = std::abs(double(strip.firstCell(at) + k) - positions[std::size_t(at)]);
            strip.row(at)[k] /= float(1.0 + levels[std::size_t(at)] * leakageAt(window, apart / binsPerCell));
        }
    return strip;
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

std::vector<double> areaLevels(const PathStrip &strip, const std::vector<double> &positions, double binsPerCell,
                               double cellLikeness)
{
    const double near = flankFromCells * binsPerCell + movedInWindow(positions);
    const auto bins = [&](double cells) { return Index(std::lround(cells * binsPerCell)); };
    std::vector<double> levels(positions.size(), 1.0);
    AreaSearch search(strip, positions, binsPerCell * cellLikeness);
    for (const auto &[isBelow, isAbove] : {std::pair{true, false}, std::pair{false, true}, std::pair{true, true}})
        search.raise(levels, bins(besideFromCells), bins(besideToCells), isBelow, isAbove);
    search.raise(levels, Index(std::ceil(near)), Index(std::floor(near + flankCells * binsPerCell)), true, true);
    return levels;
}

namespace {

    /// |ln(b/a)| of successive means over `length` frames, in the bins beside a path.
    std::vector<float> changesBeside(const PathStrip &strip, const std::vector<double> &positions, Index length,
                                     double binsPerCell)
    {
        const auto near = Index(std::lround(besideFromCells * binsPerCell + movedInWindow(positions)));
        const auto far = Index(std::lround(besideToCells * binsPerCell + movedInWindow(positions)));
        std::vector<float> changes;
        for (Index bin = -far; bin <= far; ++bin) {
            double before = std::numeric_limits<double>::quiet_NaN();
            for (Index first = 0; std::abs(bin) >= near && first + length <= strip.frameCount(); first += length) {
                double sum = 0.0;
                for (Index at = first; at < first + length; ++at)
                    sum += double(strip.valueAt(at, Index(std::lround(positions[std::size_t(at)])) + bin));
                if (const auto change = float(std::abs(std::log(sum / before))); !std::isnan(change))
                    changes.push_back(change);
                before = sum;
            }
        }
        return changes;
    }

} // namespace

double runsBeside(const PathStrip &strip, const std::vector<double> &positions, Index n, double binsPerCell,
                  double cellLikeness, double overlap)
{
    double runs = 1.0;
    for (Index length = 2; length <= std::min({n, longestRunFrames, strip.frameCount() / fewestMeans}); length *= 2) {
        std::vector<float> changes = changesBeside(strip, positions, length, binsPerCell);
        const double pairs = double(changes.size()) / (pairsAlike * binsPerCell * cellLikeness);
        if (pairs < fewestPairs)
            break;
        const double deviation = double(medianOf(changes)) / medianDeviations;
        const double shape = 2.0 / (deviation * deviation) + 0.25;
        runs = std::max(runs, double(length) / (overlap * shape) / (1.0 + 2.0 * shapeError / std::sqrt(pairs)));
    }
    return runs;
}

} // namespace faintline
