#pragma once

#include "evaluate/comparison/settingDifferences.h"

#include <QString>

namespace faintline {

/// A value of a setting as text, with its unit if it is a number: "0.5 s", "automatic", "on".
QString valueWords(const FieldInfo &field, const std::string &value);

/// "Design SNR 0.5 → 0.25"; choices appear by their names, a setting that one side does not have as a dash.
QString differenceWords(const SettingDifference &difference);

} // namespace faintline
