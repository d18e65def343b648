#include "track/Cluster.h"

#include "base/multiversion.h"
#include "detect/Detector.h"

#include <algorithm>

namespace faintline {

namespace {

    FAINTLINE_MULTIVERSION
    bool anyAbove(const float *values, std::size_t n, float limit)
    {
        int above = 0;
        for (std::size_t i = 0; i < n; ++i)
            above |= values[i] > limit ? 1 : 0;
        return above != 0;
    }

    bool anyAbove(std::span<const float> values, float limit)
    {
        return anyAbove(values.data(), values.size(), limit);
    }

} // namespace

std::vector<Cluster> findClusters(const Grid &grid, std::span<const float> statistic, double threshold, double shoulder,
                                  const std::vector<Index> &linkCells)
{
    std::vector<Index> crossings;
    if (!anyAbove(statistic, float(threshold)))
        return {};
    const auto limit = float(std::min(threshold, shoulder));
    for (Index cell = 0; cell < std::ssize(statistic); ++cell)
        if (statistic[std::size_t(cell)] > limit)
            crossings.push_back(cell);
    std::vector<Cluster> clusters;
    std::vector<bool> taken(crossings.size(), false);
    const auto positionOf = [&](Index cell) -> std::ptrdiff_t {
        const auto found = std::lower_bound(crossings.begin(), crossings.end(), cell);
        return found != crossings.end() && *found == cell ? found - crossings.begin() : -1;
    };
    for (std::size_t seed = 0; seed < crossings.size(); ++seed) {
        if (taken[seed])
            continue;
        Cluster cluster;
        std::vector<Index> open{crossings[seed]};
        taken[seed] = true;
        while (!open.empty()) {
            const Index cell = open.back();
            open.pop_back();
            cluster.cells.push_back(cell);
            CellBox{grid.coordinates(cell), linkCells}.forEachCell(grid, [&](Index neighbour) {
                const std::ptrdiff_t position = positionOf(neighbour);
                if (position >= 0 && !taken[std::size_t(position)]) {
                    taken[std::size_t(position)] = true;
                    open.push_back(neighbour);
                }
            });
        }
        std::sort(cluster.cells.begin(), cluster.cells.end());
        cluster.peakCell = cluster.cells.front();
        for (Index cell : cluster.cells)
            if (statistic[std::size_t(cell)] > statistic[std::size_t(cluster.peakCell)])
                cluster.peakCell = cell;
        cluster.peakStatistic = statistic[std::size_t(cluster.peakCell)];
        if (cluster.peakStatistic > float(threshold))
            clusters.push_back(std::move(cluster));
    }
    std::sort(clusters.begin(), clusters.end(),
              [](const Cluster &a, const Cluster &b) { return a.peakCell < b.peakCell; });
    return clusters;
}

} // namespace faintline
