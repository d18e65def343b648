#pragma once

#include "base/Field.h"

#include <QString>

namespace faintline {

/// Display texts for names in files and on the command line. The labels of settings come from their table; names
/// without a label are spelled out.

/// Of a setting of an analysis, "decide.falseAlarmsPerHour".
QString settingLabel(const QString &name);

/// "smd" → "Sequential Markov".
QString stageLabel(const QString &prefix);

/// A value of a setting: "halfDown" → "half rounds down". Settings may share the name of a value and differ in its
/// meaning.
QString choiceLabel(const FieldInfo &setting, const QString &choice);

} // namespace faintline
