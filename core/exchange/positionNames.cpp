#include "exchange/positionNames.h"

namespace faintline {

std::vector<std::string> positionNames(const Grid &grid)
{
    std::vector<std::string> names;
    for (const Axis &axis : grid.axes)
        names.push_back(grid.isSpectrum() ? "f" : axis.name);
    return names;
}

} // namespace faintline
