#include "plan/firstSettings.h"

namespace faintline {

AnalysisSettings firstSettings(const Grid &grid)
{
    if (grid.isSpectrum())
        return {};
    return preset(grid.isSurface() ? "sonar" : "radar").settings;
}

} // namespace faintline
