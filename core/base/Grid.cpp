#include "base/Grid.h"

#include <algorithm>
#include <numeric>

namespace faintline {

Index Grid::size() const
{
    if (axes.empty())
        return 0;
    Index product = 1;
    for (const Axis &axis : axes)
        product *= axis.count;
    return product;
}

std::string Grid::axisCountWords() const
{
    return std::to_string(axes.size()) + (isSpectrum() ? " axis" : " axes");
}

Index Grid::stride(std::size_t axis) const
{
    return std::accumulate(axes.begin() + Index(axis) + 1, axes.end(), Index(1),
                           [](Index product, const Axis &later) { return product * later.count; });
}

std::vector<Index> Grid::coordinates(Index cell) const
{
    std::vector<Index> result(axes.size());
    std::transform(axes.rbegin(), axes.rend(), result.rbegin(), [&cell](const Axis &axis) {
        const Index coordinate = cell % axis.count;
        cell /= axis.count;
        return coordinate;
    });
    return result;
}

std::vector<double> Grid::position(Index cell) const
{
    std::vector<double> result;
    for (auto axis = axes.begin(); const Index coordinate : coordinates(cell))
        result.push_back((axis++)->value(double(coordinate)));
    return result;
}

Index Grid::cell(const std::vector<Index> &coordinates) const
{
    Index flat = 0;
    for (auto coordinate = coordinates.begin(); const Axis &axis : axes) {
        const Index inside = axis.wrapped(*coordinate++);
        if (inside < 0)
            return -1;
        flat = flat * axis.count + inside;
    }
    return flat;
}

} // namespace faintline
