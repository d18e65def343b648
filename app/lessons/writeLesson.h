#pragma once

#include <QString>

namespace faintline {

class WindowParts;

/// Writes what the window shows as a lesson of one step: source, settings, open panels, zoom, cursor, and measures as
/// facts; titles and texts are placeholders. A source that no file holds (a bundled or changed scene, raw samples,
/// added lines) is written beside the lesson. Throws Error.
void writeNewLesson(WindowParts &window, const QString &path);

/// Adds what the window shows to a lesson file as its last step. Throws Error.
void addLessonStep(WindowParts &window, const QString &path);

} // namespace faintline
