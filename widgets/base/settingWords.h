#pragma once

#include <QString>

namespace faintline {

/// Display texts for names in files and on the command line. Names that are not listed are converted automatically, so
/// a new setting needs no entry here.

/// "decide.falseAlarmsPerHour" → "False alarms per hour".
QString settingLabel(const QString &name);

/// "smd" → "Sequential Markov".
QString stageLabel(const QString &prefix);

/// "halfDown" → "half rounds down".
QString choiceLabel(const QString &choice);

/// An example of what to type into an empty field, e.g. "all, or 0, 1" for channels. Empty for most settings.
QString settingExample(const QString &name);

/// Whether a setting is folded under "More".
bool isSeldomUsed(const QString &name);

} // namespace faintline
