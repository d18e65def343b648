#include "plan/firstSettings.h"

namespace faintline {

AnalysisSettings firstSettings(const Grid &grid)
{
    if (grid.isSpectrum())
        return {};
    return preset(grid.axes.size() == 2 ? "sonar" : "radar").settings;
}

} // namespace faintline
