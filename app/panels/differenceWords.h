#pragma once

#include "evaluate/comparison/settingDifferences.h"

#include <QString>

namespace faintline {

/// "Design SNR 0.5 → 0.25"; choices appear by their names, a setting that one side does not have as a dash.
QString differenceWords(const SettingDifference &difference);

} // namespace faintline
