#include "track/levelBeside.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace faintline {

namespace {

    constexpr double nearestCells = 2.5; ///< where the main lobe of any window has ended
    constexpr double farthestCells = 7.0;
    constexpr Index reaches[] = {6, 24, 72}; ///< frames, either way
    constexpr Index valuesPerReach = 6;      ///< the level is taken anew after this share of it
    constexpr double share = 0.35;           ///< of the values, below the quantile: lines may fill the rest
    constexpr double deviations = 1.5;
    constexpr double framesPerWindow = 2.0; ///< more of them tell hardly more
    constexpr std::size_t fewestValues = 8;

    /// Bins beside a path, nearest to farthest or the other way round.
    struct Side {
        Index from;
        Index to;
    };

    double quantileOfNoise()
    {
        return -std::log1p(-share);
    }

    /// Relative scatter of the quantile of so many independent values.
    double scatterOf(double count)
    {
        return std::sqrt(share / (1.0 - share) / count) / quantileOfNoise();
    }

    /// The quantile over that of noise of mean 1; 1 where too little was observed.
    double levelOf(const PathStrip &strip, Side side, Index at, Index reach, std::vector<float> &values)
    {
        values.clear();
        const Index end = std::min(strip.frameCount() - 1, at + reach);
        for (Index frame = std::max<Index>(0, at - reach); frame <= end; ++frame)
            for (Index bin = side.from; bin <= side.to; ++bin)
                if (const float y = strip.valueAt(frame, strip.centres[static_cast<std::size_t>(frame)] + bin);
                    !std::isnan(y))
                    values.push_back(y);
        if (values.size() < fewestValues)
            return 1.0;
        const auto quantile = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
        std::nth_element(values.begin(), quantile, values.end());
        return static_cast<double>(*quantile) / quantileOfNoise();
    }

} // namespace

Index levelBesideHalfWidth(double binsPerCell)
{
    return static_cast<Index>(std::ceil(farthestCells * binsPerCell));
}

std::vector<double> levelBeside(const PathStrip &strip, double binsPerCell)
{
    const auto near = static_cast<Index>(std::ceil(nearestCells * binsPerCell));
    const Index far = levelBesideHalfWidth(binsPerCell);
    std::vector<double> levels(static_cast<std::size_t>(strip.frameCount()), 1.0);
    std::vector<float> values;
    for (const Index reach : reaches) {
        const double windows = static_cast<double>(2 * reach + 1) / framesPerWindow;
        const double cells = static_cast<double>(far - near + 1) / binsPerCell;
        const double scatter = deviations * scatterOf(windows * cells); // of one side
        const Index step = std::max<Index>(1, reach / valuesPerReach);
        for (Index from = 0; from < strip.frameCount(); from += step) {
            const Index end = std::min(strip.frameCount(), from + step);
            const Index at = (from + end) / 2;
            const double below = levelOf(strip, {-far, -near}, at, reach, values);
            const double above = levelOf(strip, {near, far}, at, reach, values);
            const double least = std::max(std::max(below, above) * (1.0 - scatter),
                                          0.5 * (below + above) * (1.0 - scatter / std::numbers::sqrt2));
            for (Index frame = from; frame < end; ++frame) {
                double &level = levels[static_cast<std::size_t>(frame)];
                level = std::max(level, least);
            }
        }
    }
    return levels;
}

} // namespace faintline
