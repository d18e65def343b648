#pragma once

#include "plan/AnalysisSettings.h"

#include <string>
#include <vector>

namespace faintline {

/// One setting with different values in A and B.
struct SettingDifference {
    FieldInfo field;
    std::string a; ///< value as text; empty if the settings do not hold it (another detector)
    std::string b;
};

/// The settings in which A and B differ, in the order of the table. Of the three ways to specify a threshold, only
/// those in use by A or B are listed; for a detector that only one of them uses, only changes from its defaults.
std::vector<SettingDifference> settingDifferences(const AnalysisSettings &a, const AnalysisSettings &b);

} // namespace faintline
