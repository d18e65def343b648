#pragma once

#include "plan/AnalysisSettings.h"

namespace faintline {

/// The settings to start from for frames on a grid: the defaults for spectra, the preset "sonar" for two axes, "radar"
/// for more.
AnalysisSettings firstSettings(const Grid &grid);

} // namespace faintline
