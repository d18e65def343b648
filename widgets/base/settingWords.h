#pragma once

#include <QString>

namespace faintline {

/// Display texts for names in files and on the command line. The labels of settings come from their table; names
/// without a label are spelled out.

/// Of a setting of an analysis, "decide.falseAlarmsPerHour".
QString settingLabel(const QString &name);

/// "smd" → "Sequential Markov".
QString stageLabel(const QString &prefix);

/// "halfDown" → "half rounds down".
QString choiceLabel(const QString &choice);

} // namespace faintline
