#include "track/boxExtent.h"

#include <algorithm>
#include <cstdlib>

namespace faintline {

namespace {

    constexpr double skirtPower = 8.0; ///< y that noise rarely exceeds
    constexpr Index skirtLimitSteps = 16;

} // namespace

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
