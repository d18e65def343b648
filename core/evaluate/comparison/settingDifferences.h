#pragma once

#include "analysis/AnalysisSettings.h"

#include <string>
#include <vector>

namespace faintline {

/// One setting in which two differ.
struct SettingDifference {
    FieldInfo field;
    std::string a; ///< its value as text; empty where the settings do not hold it (another detector's)
    std::string b;
};

/// The settings in which A and B differ, in the order of the table. Of the three by which a threshold can be given only
/// those that count in A or B; of a detector that only one of them has chosen, only what was changed from its defaults.
std::vector<SettingDifference> settingDifferences(const AnalysisSettings &a, const AnalysisSettings &b);

} // namespace faintline
