#pragma once

#include <QString>

namespace faintline {

/// Words for people, from the names that files and the command line use. What is not in the lists is made from the name
/// itself, so a new setting needs no entry here.

/// "decide.falseAlarmsPerHour" → "False alarms per hour".
QString settingLabel(const QString &name);

/// "smd" → "Sequential Markov".
QString stageLabel(const QString &prefix);

/// "halfDown" → "half rounds down".
QString choiceLabel(const QString &choice);

/// What may be typed, where nothing is: "all, or 0, 1" channels. Empty for most settings.
QString settingExample(const QString &name);

/// Whether a setting is folded away under "More".
bool isSeldomUsed(const QString &name);

} // namespace faintline
