#pragma once

#include "app/lessons/LessonCondition.h"
#include "base/Field.h"

#include <optional>
#include <string>

namespace faintline {

class WindowParts;

/// Measures of the window for lessons, by name:
///
///     cursor.seconds, cursor.hz, cursor.range, cursor.bearing, visible.seconds, visible.hz, level, statistic
///     frameSeconds, binHz, windowSeconds, aboveTwice (share of cells whose power is more than twice the noise's mean)
///     threshold, falseAlarmsPerHour (on noise), events, peak, resetFraction, lnK
///     lines.found: how many of the truth's lines or targets a shown track follows; events.false: shown tracks that
///         follow none of them
///     line.1.followed, line.1.tracks, line.1.peak, line.1.seconds: of the truth's first line or target, the share of
///         its frames that a shown track goes along with, how many do so, their largest statistic, how long after its
///         beginning the first was detected
///     why.lnP: mean ln P of the path in the path breakdown
///     walks.noise, walks.target (mean stages), walks.wrong, walks.fixed (stages of a test of fixed size),
///     survey.saved, walks.selected ("noise" or "target"), walks.stage, walks.stages
///     test.NAME: a setting of the sequential test; view.NAME: 1 while it can be seen; any setting by its own name
///
/// Words for non-numeric measures. Nothing if the measure is currently unavailable.
std::optional<FieldValue> lessonMeasure(WindowParts &window, const std::string &name);

/// Throws Error if there is no measure of that name.
void checkMeasure(const std::string &name, const std::string &where);

bool holds(WindowParts &window, const LessonCondition &condition);

/// The first part that does not hold, and the actual value; empty if all hold. For tests and authors of lessons.
std::string failure(WindowParts &window, const LessonCondition &condition);

} // namespace faintline
