#pragma once

#include "plan/AnalysisSettings.h"

#include <string_view>

namespace faintline {

/// Whether a setting affects the results with the others as they are, for example ln K only with a fixed reset rule.
/// Forms do not show those that do not. Settings of other detectors than the selected one do not apply.
bool settingApplies(std::string_view name, const AnalysisSettings &settings);

} // namespace faintline
