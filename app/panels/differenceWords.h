#pragma once

#include "evaluate/comparison/settingDifferences.h"

#include <QString>

namespace faintline {

/// "Design SNR 0.5 → 0.25", with words for choices and a dash where one of the two has no such setting.
QString differenceWords(const SettingDifference &difference);

} // namespace faintline
