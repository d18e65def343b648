#include "track/Cluster.h"

#include "base/multiversion.h"
#include "track/constants.h"

#include <algorithm>
#include <cstdlib>

namespace faintline {

namespace {

    FAINTLINE_MULTIVERSION
    bool exceeds(const float *values, std::size_t n, float limit)
    {
        int above = 0;
        for (std::size_t i = 0; i < n; ++i)
            above |= values[i] > limit ? 1 : 0;
        return above != 0;
    }

} // namespace

bool anyAbove(std::span<const float> statistic, double threshold)
{
    return exceeds(statistic.data(), statistic.size(), float(threshold));
}

std::vector<Cluster> findClusters(const Grid &grid, std::span<const float> statistic, double threshold, double shoulder,
                                  const std::vector<Index> &linkCells)
{
    std::vector<Index> crossings;
    if (!anyAbove(statistic, threshold))
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

CellBox overSkirts(CellBox box, const Grid &grid, std::span<const float> y, Index step)
{
    const Index middle = grid.cell(box.centre);
    const double level = double(std::max(0.0f, y[std::size_t(middle)])); // 0 if not observed
    if (step <= 0 || level < skirtPower)
        return box;
    // Beyond the window's own side lobes a modulated line has skirts: extend the box down the hill to where it stops
    // falling.
    const Axis &axis = grid.axes.back();
    const Index position = box.centre.back();
    const auto hillOn = [&](Index direction) {
        const auto groupPeak = [&](Index from) {
            float peak = 0.0f;
            for (Index i = 0; i < step; ++i)
                if (const Index cell = axis.wrapped(position + direction * (from + i)); cell >= 0)
                    peak = std::max(peak, y[std::size_t(middle - position + cell)]);
            return peak;
        };
        Index reach = box.halfWidth.back();
        const Index limit = reach + skirtLimitSteps * step;
        float before = groupPeak(std::max<Index>(0, reach - step + 1));
        while (reach < limit) {
            const float next = groupPeak(reach + 1);
            if (double(next) < skirtPower || next > before)
                break;
            before = next;
            reach += step;
        }
        return reach;
    };
    const Index below = hillOn(-1);
    const Index above = hillOn(+1);
    box.halfWidth.back() = (below + above + 1) / 2;
    box.centre.back() = position + (above - below) / 2;
    if (const Index inside = axis.wrapped(box.centre.back()); inside >= 0)
        box.centre.back() = inside;
    return box;
}

CellBox overCells(CellBox box, const Grid &grid, std::span<const Index> cells, const std::vector<Index> &margin)
{
    for (Index cell : cells) {
        const std::vector<Index> c = grid.coordinates(cell);
        for (std::size_t axis = 0; axis < c.size(); ++axis) {
            const Index distance = std::abs(grid.axes[axis].steps(box.centre[axis], c[axis]));
            box.halfWidth[axis] = std::max(box.halfWidth[axis], distance + margin[axis]);
        }
    }
    return box;
}

} // namespace faintline
